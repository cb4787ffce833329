#include "io/image_decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/image_input.h"
#include "io/image_png.h"
#include "io/image_pnm.h"
#include "io/image_ppm.h"

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;

bool has_at(Bytes bytes, std::size_t offset, std::string_view magic) {
  return bytes.size() >= offset + magic.size() && std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

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
void divide_by_alpha(std::vector<std::uint8_t>& rgba) {
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) {
    const int alpha = rgba[i + 3];
    if (alpha == 0) continue;
    for (std::size_t k = i; k < i + 3; ++k)
      rgba[k] = static_cast<std::uint8_t>(std::min(255, (rgba[k] * 255 + alpha / 2) / alpha));
  }
}

}  // namespace

void check_image_size(std::int64_t width, std::int64_t height, std::size_t encoded_bytes) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1) throw std::runtime_error("image without pixels (" + size + ")");
  if (width > max_image_size || height > max_image_size)
    throw std::runtime_error("image of " + size + " pixels; the limit is " + std::to_string(max_image_size) + " x " +
                             std::to_string(max_image_size));
  // Deflate reaches about 1030:1, which is 8240 one-bit pixels per byte, and other formats of real pictures stay far
  // below: a header that promises more than this in a large image is damaged, or meant to eat memory.
  constexpr std::size_t free_pixels = std::size_t{1} << 24, pixels_per_byte = 10000;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > free_pixels && pixels / pixels_per_byte > encoded_bytes)
    throw std::runtime_error("image of " + size + " pixels in only " + std::to_string(encoded_bytes) + " bytes");
}

std::optional<ImageFormat> detect_image_format(Bytes encoded) {
  if (has_at(encoded, 0, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
  if (has_at(encoded, 0, "\xff\xd8\xff")) return ImageFormat::jpeg;
  if (has_at(encoded, 0, "RIFF") && has_at(encoded, 8, "WEBP")) return ImageFormat::webp;
  if (has_at(encoded, 0, "#?")) return ImageFormat::hdr;
  if (has_at(encoded, 0, "\x76\x2f\x31\x01")) return ImageFormat::exr;
  if (has_at(encoded, 0, "P3") || has_at(encoded, 0, "P6")) return ImageFormat::ppm;
  if (has_at(encoded, 0, {"II*\0", 4}) || has_at(encoded, 0, {"MM\0*", 4})) return ImageFormat::tiff;
  if (has_at(encoded, 0, "PF") || has_at(encoded, 0, "Pf")) return ImageFormat::pfm;
  return std::nullopt;
}

DecodedImage decode_image(Bytes encoded, ImageFormat format) {
  if (format == ImageFormat::pfm) {
    PfmImage pfm = decode_pfm(encoded, max_image_size);
    return {pfm.width, pfm.height, pfm.channels, {}, std::move(pfm.values), true};
  }
  if (format == ImageFormat::ppm) {
    PpmImage ppm = decode_ppm(encoded, max_image_size);
    return {ppm.width, ppm.height, 3, {}, std::move(ppm.values), ppm.is_linear};
  }
  if (format == ImageFormat::jpeg) check_jpeg_scans(encoded);
  std::vector<std::byte> png;
  if (format == ImageFormat::png) encoded = png = keep_png_pixels(encoded);
  OIIO::Filesystem::IOMemReader memory(encoded.data(), encoded.size());
  OIIO::ImageSpec spec;
  const std::unique_ptr<OIIO::ImageInput> input = open_image(memory, format, spec);
  check_size(spec, encoded.size());
  check_kind(spec);

  DecodedImage image;
  image.width = spec.width, image.height = spec.height;
  const bool is_layered = spec.nchannels > 4 || (format == ImageFormat::exr && has_further_layer(spec));
  const int first = is_layered ? first_color_channel(spec) : 0;
  image.channels = is_layered ? count_color_channels(spec, first) : spec.nchannels;
  const std::size_t count = static_cast<std::size_t>(spec.width) * spec.height * image.channels;
  image.is_linear = format == ImageFormat::hdr || spec.format.is_floating_point();
  image.is_unassociated = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  const bool is_8_bit = spec.format == OIIO::TypeDesc::UINT8;
  is_8_bit ? image.bytes.resize(count) : image.floats.resize(count);
  void* const pixels = is_8_bit ? static_cast<void*>(image.bytes.data()) : image.floats.data();
  const OIIO::TypeDesc type = is_8_bit ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  if (!input->read_image(0, 0, first, first + image.channels, type, pixels))
    throw std::runtime_error(first_line(input->geterror()));
  input->close();
  static_cast<void>(input->geterror());  // complaints about a readable image would be printed when it is destroyed
  if (format == ImageFormat::webp && image.channels == 4 && !image.is_unassociated) {
    divide_by_alpha(image.bytes);
    image.is_unassociated = true;
  }
  return image;
}

}  // namespace candil
