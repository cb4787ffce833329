#include "tests/core/tonemap_samples.h"

#include <gtest/gtest.h>

#include "core/color.h"

namespace candil::test {

Image row_of(const std::vector<Vec3>& colors) {
  Image image(static_cast<int>(colors.size()), 1, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = colors[i / 3][static_cast<int>(i % 3)];
  return image;
}

Image row_of_greys(const std::vector<float>& greys) {
  std::vector<Vec3> colors;
  for (const float grey : greys) colors.emplace_back(grey);
  return row_of(colors);
}

std::vector<Vec3> display_values(const Image& image, const Tonemap& tonemap, float exposure) {
  const Image display = to_display(image, exposure, tonemap);
  std::vector<Vec3> values;
  for (int x = 0; x < display.width; ++x) {
    const float* const pixel = display.pixel(x, 0);
    values.emplace_back(pixel[0], pixel[1], pixel[2]);
  }
  return values;
}

std::vector<Vec3> linear_values(const Image& image, const Tonemap& tonemap, float exposure) {
  std::vector<Vec3> values = display_values(image, tonemap, exposure);
  for (Vec3& value : values)
    for (int i = 0; i < 3; ++i) value[i] = srgb_to_linear(value[i]);
  return values;
}

Vec3 linear_value(Vec3 color, const Tonemap& tonemap) { return linear_values(row_of({color}), tonemap)[0]; }

}  // namespace candil::test
