#include "io/image_encoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "io/image_pnm.h"
#include "io/image_ppm.h"

namespace candil {
namespace {

const char* library_name(const std::string& extension) {
  if (extension == ".exr") return "openexr";
  if (extension == ".hdr") return "hdr";
  if (extension == ".png") return "png";
  if (extension == ".jpg" || extension == ".jpeg") return "jpeg";
  return "tiff";
}

/// The first `channels` channels of an image that may have more, or no alpha (then 1).
std::vector<float> select_channels(const Image& image, int channels) {
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  std::vector<float> values(count * channels, 1.0f);
  const int copied = std::min(channels, image.channels);
  for (std::size_t i = 0; i < count; ++i) std::copy_n(&image.pixels[i * image.channels], copied, &values[i * channels]);
  return values;
}

/// Rounds to the nearest of 256 levels; written out here so that every version of the library gives the same bytes.
std::vector<std::uint8_t> to_bytes(const std::vector<float>& values) {
  std::vector<std::uint8_t> bytes(values.size());
  std::transform(values.begin(), values.end(), bytes.begin(), [](float value) {
    return value > 0 ? static_cast<std::uint8_t>(std::min(value, 1.0f) * 255.0f + 0.5f) : std::uint8_t{0};
  });
  return bytes;
}

/// The library would write the time of day instead, and no two files would be the same.
constexpr const char* fixed_time = "1970:01:01 00:00:00";

void set_exr_attributes(OIIO::ImageSpec& spec, const ImageMetadata& metadata) {
  spec.attribute("DateTime", fixed_time);
  spec.attribute("compression", "zip");
  for (const auto& [key, value] : metadata) spec.attribute(key, value);
}

OIIO::ImageSpec make_spec(const std::string& extension, const Image& image, int channels, OIIO::TypeDesc type,
                          const ImageMetadata& metadata) {
  OIIO::ImageSpec spec(image.width, image.height, channels, type);
  spec.channelnames.assign({"R", "G", "B"});
  if (channels == 4) spec.channelnames.push_back("A"), spec.alpha_channel = 3;
  if (extension == ".exr") {
    set_exr_attributes(spec, metadata);
    return spec;
  }
  if (is_linear_format("image" + extension)) return spec;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  // Not for TIFF: the library would say it in an Exif directory, which it fails to write, and tear the file.
  if (library_name(extension) != std::string_view("tiff")) spec.attribute("oiio:ColorSpace", "sRGB");
  if (extension == ".jpg" || extension == ".jpeg") {
    spec.attribute("CompressionQuality", 95);
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  if (extension == ".tif" || extension == ".tiff") {
    spec.attribute("DateTime", fixed_time);
    spec.attribute("compression", "zip");
  }
  return spec;
}

/// `pixels` are of the type that the specification names.
std::vector<std::byte> encode_by_library(const std::string& extension, const OIIO::ImageSpec& spec,
                                         const void* pixels) {
  std::vector<unsigned char> encoded;
  OIIO::Filesystem::IOVecOutput memory(encoded);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(library_name(extension));
  if (!output) {
    OIIO::geterror();
    throw std::runtime_error("this OpenImageIO cannot write " + extension + " files");
  }
  if (!output->set_ioproxy(&memory) || !output->open("image" + extension, spec) ||
      !output->write_image(spec.format, pixels) || !output->close()) {
    const std::string message = output->geterror();
    throw std::runtime_error("cannot be encoded: " + message.substr(0, message.find('\n')));
  }
  static_cast<void>(output->geterror());  // complaints about a written image would be printed when it is destroyed
  const auto* const first = reinterpret_cast<const std::byte*>(encoded.data());
  return std::vector<std::byte>(first, first + encoded.size());
}

}  // namespace

std::vector<std::byte> encode_image(const std::string& extension, const Image& image, bool with_alpha,
                                    const ImageMetadata& metadata, PpmKind ppm, int png_level) {
  const int channels = with_alpha && has_alpha_channel("image" + extension) ? 4 : 3;
  const bool is_8_bit = !is_linear_format("image" + extension, ppm);
  const OIIO::TypeDesc type = is_8_bit ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  const std::vector<float> selected =
      channels == image.channels ? std::vector<float>() : select_channels(image, channels);
  const std::vector<float>& values = channels == image.channels ? image.pixels : selected;
  const std::vector<std::uint8_t> bytes = is_8_bit ? to_bytes(values) : std::vector<std::uint8_t>();
  if (extension == ".ppm" && ppm == PpmKind::hdr) return encode_hdr_ppm(image.width, image.height, values);
  if (extension == ".ppm" && ppm == PpmKind::ascii) return encode_ascii_ppm(image.width, image.height, bytes);
  if (extension == ".ppm") return encode_ppm(image.width, image.height, bytes);
  if (extension == ".pfm") return encode_pfm(image.width, image.height, values);

  const void* pixels = is_8_bit ? static_cast<const void*>(bytes.data()) : values.data();
  OIIO::ImageSpec spec = make_spec(extension, image, channels, type, metadata);
  if (extension == ".png") spec.attribute("png:compressionLevel", png_level);
  return encode_by_library(extension, spec, pixels);
}

std::vector<std::byte> encode_layers(std::span<const ImageLayer> layers, const ImageMetadata& metadata) {
  const Image& first = layers.front().image;
  int channels = 0;
  for (const ImageLayer& layer : layers) channels += layer.image.channels;
  OIIO::ImageSpec spec(first.width, first.height, channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  spec.alpha_channel = spec.z_channel = -1;
  const std::size_t pixels = static_cast<std::size_t>(first.width) * first.height;
  std::vector<float> values(pixels * channels);
  int begin = 0;
  for (const ImageLayer& layer : layers) {
    const Image& image = layer.image;
    for (const std::string& channel : layer.channels)
      spec.channelnames.push_back(layer.name.empty() ? channel : layer.name + "." + channel);
    for (std::size_t i = 0; i < pixels; ++i)
      std::copy_n(&image.pixels[i * image.channels], image.channels, &values[i * channels + begin]);
    begin += image.channels;
  }
  set_exr_attributes(spec, metadata);
  return encode_by_library(".exr", spec, values.data());
}

}  // namespace candil
