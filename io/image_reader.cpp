#include "io/image_reader.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "io/image_avif.h"
#include "io/image_input.h"
#include "io/image_png.h"

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;

/// A progressive JPEG may ask for any number of passes over its pixels; honest files have about ten. Inside of
/// compressed data FF is never followed by DA, so that counting the byte pair finds the scans.
void check_jpeg_scans(Bytes encoded) {
  constexpr int max_scans = 500;
  int scans = 0;
  for (std::size_t i = 0; i + 1 < encoded.size(); ++i)
    scans += encoded[i] == std::byte{0xff} && encoded[i + 1] == std::byte{0xda};
  if (scans > max_scans) throw std::runtime_error("more than 500 JPEG scans");
}

/// A file of up to four channels that are not one picture: R, G, B and depth.Z, say, or U and V. Two or four channels
/// of one picture end in alpha.
bool has_further_layer(const OIIO::ImageSpec& spec) {
  return spec.nchannels % 2 == 0 && spec.alpha_channel != spec.nchannels - 1;
}

/// Where R, G and B start. Layered EXR files name them "Layer.R"; the first set of three neighbours counts.
int first_color_channel(const OIIO::ImageSpec& spec) {
  const auto ends_with = [&](int channel, std::string_view letter) {
    const std::string& name = spec.channelnames[channel];
    return name == letter || name.ends_with("." + std::string(letter));
  };
  for (int i = 0; i + 2 < static_cast<int>(spec.channelnames.size()); ++i)
    if (ends_with(i, "R") && ends_with(i + 1, "G") && ends_with(i + 2, "B")) return i;
  throw std::runtime_error("no channels R, G and B among its " + std::to_string(spec.nchannels));
}

/// R, G, B and, where it follows, A of the same layer.
int count_color_channels(const OIIO::ImageSpec& spec, int first) {
  const std::size_t alpha = static_cast<std::size_t>(first) + 3;
  if (alpha >= spec.channelnames.size()) return 3;
  std::string expected = spec.channelnames[first];
  expected.back() = 'A';
  return spec.channelnames[alpha] == expected ? 4 : 3;
}

/// OpenImageIO before 2.5 multiplies the colours of WebP files by alpha, whatever it is asked. What alpha 0 has
/// erased stays black.
void divide_by_alpha(std::span<std::uint8_t> rgba) {
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
    const int alpha = rgba[i + 3];
    if (alpha == 0) continue;
    for (std::size_t k = i; k < i + 3; ++k)
      rgba[k] = static_cast<std::uint8_t>(std::min(255, (rgba[k] * 255 + alpha / 2) / alpha));
  }
}

/// Copies `count` pixels of `channels` values to places that are `stride` values apart.
template <typename Value>
void spread(const Value* from, std::size_t count, int channels, Value* to, int stride) {
  if (channels == 3 && stride == 4) {  // the usual case, in a form that compilers make fast
    for (std::size_t i = 0; i < count; ++i) {
      to[4 * i] = from[3 * i];
      to[4 * i + 1] = from[3 * i + 1];
      to[4 * i + 2] = from[3 * i + 2];
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i, from += channels, to += stride) std::copy_n(from, channels, to);
}

}  // namespace

ImageReader::ImageReader(Bytes encoded, ImageFormat format)
    : format_(format),
      png_(format == ImageFormat::png ? keep_png_pixels(encoded) : std::vector<std::byte>()),
      encoded_(format == ImageFormat::png ? Bytes(png_) : encoded),
      memory_(encoded_.data(), encoded_.size()),
      input_(create_image_input(format)) {
  if (format == ImageFormat::jpeg) check_jpeg_scans(encoded_);
  if (format == ImageFormat::avif) check_avif(encoded_);
  if (input_->supports("ioproxy")) {
    open_image(*input_, memory_, spec_);
  } else {
    open_image(*input_, copy_.emplace(encoded_), spec_);
  }
  check_size(spec_, encoded_.size());
  check_kind(spec_);
  const bool is_layered = spec_.nchannels > 4 || (format == ImageFormat::exr && has_further_layer(spec_));
  first_channel_ = is_layered ? first_color_channel(spec_) : 0;
  channels_ = is_layered ? count_color_channels(spec_, first_channel_) : spec_.nchannels;
}

bool ImageReader::is_8_bit() const { return spec_.format == OIIO::TypeDesc::UINT8; }

bool ImageReader::is_linear() const { return format_ == ImageFormat::hdr || spec_.format.is_floating_point(); }

bool ImageReader::has_multiplied_webp() const {
  return format_ == ImageFormat::webp && channels_ == 4 && spec_.get_int_attribute("oiio:UnassociatedAlpha") == 0;
}

bool ImageReader::is_unassociated() const {
  return has_multiplied_webp() || spec_.get_int_attribute("oiio:UnassociatedAlpha") != 0;
}

template <typename Value>
void ImageReader::read_as(OIIO::TypeDesc type, Value* pixels, int stride) {
  const int width = spec_.width, height = spec_.height, last_channel = first_channel_ + channels_;
  const auto fail = [&] { throw std::runtime_error(first_line(input_->geterror())); };
  if (stride == channels_ || spec_.tile_width != 0) {
    const auto pixel_bytes = static_cast<OIIO::stride_t>(sizeof(Value)) * stride;
    if (!input_->read_image(0, 0, first_channel_, last_channel, type, pixels, pixel_bytes)) fail();
  } else {
    // The library spreads pixels one by one, through a copy of the whole image; some rows at a time stay in the cache.
    constexpr int rows = 16;
    std::vector<Value> values(static_cast<std::size_t>(width) * rows * static_cast<std::size_t>(channels_));
    for (int y = 0; y < height; y += rows) {
      const int end = std::min(y + rows, height);
      if (!input_->read_scanlines(0, 0, y, end, 0, first_channel_, last_channel, type, values.data())) fail();
      spread(values.data(), static_cast<std::size_t>(width) * static_cast<std::size_t>(end - y), channels_, pixels,
             stride);
      pixels += static_cast<std::size_t>(width) * static_cast<std::size_t>(end - y) * static_cast<std::size_t>(stride);
    }
  }
  input_->close();
  static_cast<void>(input_->geterror());  // complaints about a readable image would be printed when it is destroyed
}

void ImageReader::read(std::uint8_t* pixels, int stride) {
  read_as(OIIO::TypeDesc::UINT8, pixels, stride);
  if (has_multiplied_webp())
    divide_by_alpha({pixels, 4 * static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.height)});
}

void ImageReader::read(float* pixels, int stride) { read_as(OIIO::TypeDesc::FLOAT, pixels, stride); }

}  // namespace candil
