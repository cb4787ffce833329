#include <algorithm>
#include <cmath>

#include "io/error.h"
#include "io/image_file.h"

namespace candil {
namespace {

Image without_alpha(const Image& image) {
  Image rgb(image.width, image.height, 3);
  for (std::size_t i = 0; i < rgb.pixels.size() / 3; ++i)
    std::copy_n(&image.pixels[i * static_cast<std::size_t>(image.channels)], 3, &rgb.pixels[i * 3]);
  return rgb;
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
  Image image = without_alpha(read_image(path));
  check_values(image, path.string());
  // Resampling leaves tiny negative values in many published environments; light is not negative.
  for (float& value : image.pixels) value = std::max(value, 0.0f);
  return image;
}

}  // namespace candil
