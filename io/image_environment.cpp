#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>

#include "core/color.h"
#include "io/error.h"
#include "io/image_decoder.h"
#include "io/image_file.h"

namespace candil {
namespace {

std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
  constexpr std::uintmax_t max_bytes = std::uintmax_t{1} << 32;
  std::error_code status;
  if (!std::filesystem::exists(path, status)) throw InputError(path.string(), "", "no such file");
  if (!std::filesystem::is_regular_file(path, status)) throw InputError(path.string(), "", "not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, status);
  if (status) throw InputError(path.string(), "", status.message());
  if (size > max_bytes) throw InputError(path.string(), "", "larger than 4 GiB");
  std::ifstream stream(path, std::ios::binary);
  std::vector<std::byte> bytes(size);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    throw InputError(path.string(), "", "cannot be read");
  return bytes;
}

Image to_linear_rgb(const DecodedImage& decoded, bool is_srgb) {
  const bool is_grey = decoded.channels < 3;
  Image image(decoded.width, decoded.height, 3);
  const std::size_t pixels = image.pixels.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const std::size_t from = i * decoded.channels + (is_grey ? 0 : channel);
      const float value =
          decoded.bytes.empty() ? decoded.floats[from] : static_cast<float>(decoded.bytes[from]) / 255.0f;
      // Resampling leaves tiny negative values in many published environments; light is not negative.
      image.pixels[i * 3 + channel] = is_srgb ? srgb_to_linear(value) : value < 0 ? 0.0f : value;
    }
  return image;
}

void check_values(const Image& image, const std::string& file) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (std::isfinite(image.pixels[i])) continue;
    const std::size_t pixel = i / 3, width = static_cast<std::size_t>(image.width);
    const std::string place = "pixel (" + std::to_string(pixel % width) + ", " + std::to_string(pixel / width) + ")";
    throw InputError(file, place, "radiance must be finite, not " + std::to_string(image.pixels[i]));
  }
}

}  // namespace

Image read_environment(const std::filesystem::path& path) {
  const std::vector<std::byte> encoded = read_bytes(path);
  const std::optional<ImageFormat> format = detect_image_format(encoded);
  if (!format) throw InputError(path.string(), "", "not an HDR, EXR, PFM, PNG, JPEG or WebP image");
  const bool is_srgb = *format == ImageFormat::png || *format == ImageFormat::jpeg || *format == ImageFormat::webp;
  try {
    const Image image = to_linear_rgb(decode_image(encoded, *format), is_srgb);
    check_values(image, path.string());
    return image;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw InputError(path.string(), "", error.what());
  }
}

}  // namespace candil
