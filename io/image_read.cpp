#include <algorithm>
#include <cstdint>
#include <fstream>
#include <span>
#include <stdexcept>

#include "core/color.h"
#include "io/error.h"
#include "io/image_decoder.h"
#include "io/image_file.h"
#include "io/image_layers.h"

namespace candil {
namespace {

/// The first `most` bytes of a file, or all.
std::vector<std::byte> read_bytes(const std::filesystem::path& path, std::uintmax_t most = ~std::uintmax_t{0}) {
  constexpr std::uintmax_t max_bytes = std::uintmax_t{1} << 32;
  std::error_code status;
  if (!std::filesystem::exists(path, status)) throw InputError(path.string(), "", "no such file");
  if (!std::filesystem::is_regular_file(path, status)) throw InputError(path.string(), "", "not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, status);
  if (status) throw InputError(path.string(), "", status.message());
  if (size > max_bytes) throw InputError(path.string(), "", "larger than 4 GiB");
  std::ifstream stream(path, std::ios::binary);
  std::vector<std::byte> bytes(std::min(size, most));
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
    throw InputError(path.string(), "", "cannot be read");
  return bytes;
}

float stored_value(const DecodedImage& decoded, std::size_t i) {
  return decoded.bytes.empty() ? decoded.floats[i] : static_cast<float>(decoded.bytes[i]) / 255.0f;
}

/// Linear and premultiplied; `alpha` is that of the pixel.
float linear_value(const DecodedImage& decoded, float stored, float alpha) {
  if (decoded.is_unassociated) return alpha * (decoded.is_linear ? stored : srgb_to_linear(stored));
  if (decoded.is_linear) return stored;
  return alpha > 0 ? alpha * srgb_to_linear(stored / alpha) : srgb_to_linear(stored);
}

Image to_linear(const DecodedImage& decoded) {
  const bool is_grey = decoded.channels < 3, has_alpha = decoded.channels == 2 || decoded.channels == 4;
  Image image(decoded.width, decoded.height, has_alpha ? 4 : 3);
  const std::size_t from_channels = static_cast<std::size_t>(decoded.channels);
  const std::size_t to_channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size() / to_channels; ++i) {
    const std::size_t from = i * from_channels;
    const float alpha = has_alpha ? stored_value(decoded, from + from_channels - 1) : 1.0f;
    float* const pixel = &image.pixels[i * to_channels];
    for (std::size_t k = 0; k < 3; ++k)
      pixel[k] = linear_value(decoded, stored_value(decoded, from + (is_grey ? 0 : k)), alpha);
    if (has_alpha) pixel[3] = alpha;
  }
  return image;
}

/// The stored values as a picture of one layer.
LayeredImage as_picture(const DecodedImage& decoded, const LayerChoice& choose) {
  LayeredImage result;
  result.width = decoded.width, result.height = decoded.height;
  result.is_linear = decoded.is_linear, result.is_8_bit = !decoded.bytes.empty();
  result.names = {""};
  if (choose(result.names).empty()) return result;
  const bool has_alpha = decoded.channels == 2 || decoded.channels == 4;
  ImageLayer layer{"", {"R", "G", "B"}, Image(decoded.width, decoded.height, has_alpha ? 4 : 3)};
  if (has_alpha) layer.channels.emplace_back("A");
  const auto from = static_cast<std::size_t>(decoded.channels), to = layer.channels.size();
  for (std::size_t i = 0; i < layer.image.pixels.size() / to; ++i) {
    const float alpha = has_alpha ? stored_value(decoded, i * from + from - 1) : 1.0f;
    float* const pixel = &layer.image.pixels[i * to];
    for (std::size_t c = 0; c < 3; ++c)
      pixel[c] = stored_value(decoded, i * from + (from < 3 ? 0 : c)) * (decoded.is_unassociated ? alpha : 1.0f);
    if (has_alpha) pixel[3] = alpha;
  }
  result.layers.push_back(std::move(layer));
  return result;
}

/// What `decode` makes of the file's format; what it throws names the file.
template <typename Decode>
auto read_file(const std::filesystem::path& path, std::span<const std::byte> start, const Decode& decode) {
  const std::optional<ImageFormat> format = detect_image_format(start);
  // AVIF comes in glTF files only.
  if (!format || *format == ImageFormat::avif)
    throw InputError(path.string(), "", "not an HDR, EXR, PFM, PPM, TIFF, PNG, JPEG or WebP image");
  try {
    return decode(*format);
  } catch (const std::runtime_error& error) {
    throw InputError(path.string(), "", error.what());
  }
}

}  // namespace

Image read_image(const std::filesystem::path& path) {
  const std::vector<std::byte> encoded = read_bytes(path);
  return read_file(path, encoded, [&](ImageFormat format) { return to_linear(decode_image(encoded, format)); });
}

LayeredImage read_layers(const std::filesystem::path& path, const LayerChoice& choose) {
  constexpr std::uintmax_t start = 16;
  return read_file(path, read_bytes(path, start), [&](ImageFormat format) {
    if (format == ImageFormat::exr) return decode_layers(path, choose);
    return as_picture(decode_image(read_bytes(path), format), choose);
  });
}

}  // namespace candil
