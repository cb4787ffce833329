/// SSIM against closed forms and its definition.
#include "metrics/ssim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "metrics/map_statistics.h"

namespace candil::test {
namespace {

Image grey(int width, int height, float value) {
  Image image(width, height, 3);
  std::ranges::fill(image.pixels, value);
  return image;
}

Image noise(int width, int height, std::uint32_t state) {
  Image image(width, height, 3);
  for (float& value : image.pixels) {
    state = state * 1664525u + 1013904223u;
    value = static_cast<float>(state >> 8) / 16777216.0f;
  }
  return image;
}

// Without any variance only the first factor is left: (2 a b + C1) / (a^2 + b^2 + C1), C1 = 0.01^2.
TEST(Ssim, OfConstants) {
  const double expected = (2 * 0.2 * 0.8 + 1e-4) / (0.04 + 0.64 + 1e-4);
  const Image a = grey(20, 16, 0.2f), b = grey(20, 16, 0.8f);
  for (const float value : measure_ssim({a, b, ValueKind::display}).pixels) ASSERT_NEAR(value, expected, 2e-4);
}

// Linear values are encoded first, and cut at 1.
TEST(Ssim, OfLinearConstants) {
  const double a = linear_to_srgb(0.2f), b = 1;
  const double expected = (2 * a * b + 1e-4) / (a * a + b * b + 1e-4);
  const Image first = grey(20, 16, 0.2f), second = grey(20, 16, 7);
  for (const float value : measure_ssim({first, second, ValueKind::linear}).pixels) ASSERT_NEAR(value, expected, 2e-4);
}

TEST(Ssim, IsOneForEqualImagesAndSymmetric) {
  const Image a = noise(40, 30, 1), b = noise(40, 30, 2);
  for (const float value : measure_ssim({a, a, ValueKind::display}).pixels) ASSERT_EQ(value, 1);
  EXPECT_EQ(measure_ssim({a, b, ValueKind::display}).pixels, measure_ssim({b, a, ValueKind::display}).pixels);
}

// The definition, with the whole window in double precision, at pixels inside and at a corner, where the window is cut.
TEST(Ssim, FollowsItsDefinition) {
  const Image a = noise(40, 30, 3), b = noise(40, 30, 4);
  const Image map = measure_ssim({a, b, ValueKind::display});
  const auto luma = [](const Image& image, int x, int y) {
    const float* const p = image.pixel(x, y);
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
  };
  for (const auto& [x, y] : {std::pair{20, 15}, {5, 5}, {34, 24}, {0, 0}, {39, 12}}) {
    double weights = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (int dy = -5; dy <= 5; ++dy)
      for (int dx = -5; dx <= 5; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= 40 || y + dy >= 30) continue;
        const double w = std::exp(-(dx * dx + dy * dy) / 4.5);
        const double va = luma(a, x + dx, y + dy), vb = luma(b, x + dx, y + dy);
        weights += w, sa += w * va, sb += w * vb, saa += w * va * va, sbb += w * vb * vb, sab += w * va * vb;
      }
    const double ma = sa / weights, mb = sb / weights;
    const double expected = (2 * ma * mb + 1e-4) * (2 * (sab / weights - ma * mb) + 9e-4) /
                            ((ma * ma + mb * mb + 1e-4) * (saa / weights - ma * ma + sbb / weights - mb * mb + 9e-4));
    EXPECT_NEAR(*map.pixel(x, y), expected, 1e-4) << x << ' ' << y;
  }
}

TEST(Ssim, AveragesWhereTheWindowFits) {
  EXPECT_EQ(ssim_selection(PixelSelection(20, 15)).count(), 10u * 5);
  EXPECT_EQ(ssim_selection(PixelSelection(10, 15)).count(), 150u);  // it fits nowhere
  PixelSelection border(20, 15);
  border.keep(std::vector<Region>{{0, 0, 3, 15}});
  EXPECT_EQ(ssim_selection(border).count(), 45u);
}

TEST(Ssim, ValuesThatAreNotFiniteNeverPass) {
  const Image a = grey(12, 12, 0.5f);
  Image b = a;
  b.pixel(6, 6)[2] = std::nanf("");
  const Image map = measure_ssim({a, b, ValueKind::display});
  EXPECT_EQ(*map.pixel(6, 6), 0);
  for (const float value : map.pixels) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace candil::test
