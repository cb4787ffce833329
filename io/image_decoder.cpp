#include "io/image_decoder.h"

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/image_avif.h"
#include "io/image_pnm.h"
#include "io/image_ppm.h"
#include "io/image_reader.h"

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;

bool has_at(Bytes bytes, std::size_t offset, std::string_view magic) {
  return bytes.size() >= offset + magic.size() && std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
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
  if (is_avif(encoded)) return ImageFormat::avif;
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
  ImageReader reader(encoded, format);
  DecodedImage image;
  image.width = reader.width(), image.height = reader.height(), image.channels = reader.channels();
  image.is_linear = reader.is_linear(), image.is_unassociated = reader.is_unassociated();
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height * image.channels;
  if (reader.is_8_bit()) {
    image.bytes.resize(count);
    reader.read(image.bytes.data(), image.channels);
  } else {
    image.floats.resize(count);
    reader.read(image.floats.data(), image.channels);
  }
  return image;
}

}  // namespace candil
