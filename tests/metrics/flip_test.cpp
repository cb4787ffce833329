/// FLIP against its authors' implementation, and what can be told without it.
#include "metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/flip_filters.h"
#include "metrics/flip_tone.h"
#include "metrics/map_statistics.h"
#include "tests/metrics/flip_pairs.h"
#include "tests/metrics/flip_reference_values.h"

namespace candil::test {
namespace {

double mean_of(const Image& map) { return map_mean(map, PixelSelection(map.width, map.height)); }

class FlipReferences : public testing::TestWithParam<FlipReference> {};

TEST_P(FlipReferences, AgreeWithTheAuthors) {
  const FlipReference& wanted = GetParam();
  const FlipPair pair = make_flip_pair(wanted.name);
  const Image map = measure_flip({pair.a, pair.b, wanted.is_linear ? ValueKind::linear : ValueKind::display}).map;
  constexpr double tolerance = 3e-4;
  EXPECT_NEAR(mean_of(map), wanted.mean, tolerance);
  EXPECT_NEAR(*std::ranges::max_element(map.pixels), wanted.largest, tolerance);
  const float at[] = {*map.pixel(0, 0), *map.pixel(20, 18), *map.pixel(24, 20), *map.pixel(47, 39)};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(at[i], wanted.at[i], tolerance) << i;
}

INSTANTIATE_TEST_SUITE_P(All, FlipReferences, testing::ValuesIn(flip_references), [](const auto& instance) {
  std::string name = instance.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
});

TEST(Flip, IsZeroForEqualImagesAndSymmetricForDisplayValues) {
  const FlipPair pair = make_flip_pair("noise");
  for (const ValueKind kind : {ValueKind::display, ValueKind::linear})
    for (const float value : measure_flip({pair.a, pair.a, kind}).map.pixels) ASSERT_EQ(value, 0);
  EXPECT_EQ(measure_flip({pair.a, pair.b, ValueKind::display}).map.pixels,
            measure_flip({pair.b, pair.a, ValueKind::display}).map.pixels);
}

// Two greys have no chroma, no edges and no points: what counts is the difference in L* = 116 Y^(1/3) - 16 for a linear
// luminance Y, to the power of 0.7. 0.95 stands for 0.4 of the largest one, between green (L*, a*, b*) =
// (87.74, -86.18, 83.19) and blue (32.30, 79.20, -107.86), whose a* and b* are scaled by L*/100:
//   |87.74 - 32.30| + hypot(-75.61 - 25.58, 72.98 + 34.84) = 203.30, and 203.30^0.7 = 41.277.
// Greys 0.5 and 0.6 (sRGB): Y = 0.21404 and 0.31855, L* = 53.389 and 63.223; 9.834^0.7 = 4.9534.
TEST(Flip, OfTwoGreysFollowsFromTheirLightness) {
  Image a(20, 20, 3), b(20, 20, 3);
  std::ranges::fill(a.pixels, 0.5f), std::ranges::fill(b.pixels, 0.6f);
  for (const float value : measure_flip({a, b, ValueKind::display}).map.pixels)
    ASSERT_NEAR(value, 4.9534 / (0.4 * 41.277) * 0.95, 2e-4);
}

TEST(Flip, IgnoresAlphaAndTheSizeOfItsTiles) {
  // 300 pixels take two tiles. What is far from a border or a tile's edge does not know of it.
  Image a(300, 270, 4), b(300, 270, 4);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 4; ++c) {
        a.pixel(x, y)[c] = static_cast<float>((x * 7 + y * 3 + c * 5) % 16) / 15;
        b.pixel(x, y)[c] = static_cast<float>((x * 7 + y * 3 + c * 4) % 16) / 15;
      }
  const Image map = measure_flip({a, b, ValueKind::display}).map;
  // The pattern repeats after 16 pixels in both directions.
  for (int y = 32; y < 220; ++y)
    for (int x = 32; x < 250; ++x) ASSERT_EQ(*map.pixel(x, y), *map.pixel(x + 16, y + 16)) << x << ' ' << y;
  Image opaque_a(300, 270, 3), opaque_b(300, 270, 3);
  for (std::size_t i = 0; i < opaque_a.pixels.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      opaque_a.pixels[3 * i + c] = a.pixels[4 * i + c], opaque_b.pixels[3 * i + c] = b.pixels[4 * i + c];
  EXPECT_EQ(measure_flip({opaque_a, opaque_b, ValueKind::display}).map.pixels, map.pixels);
}

TEST(Flip, ValuesThatAreNotFiniteNeverPass) {
  Image a(9, 9, 3);
  std::ranges::fill(a.pixels, 0.5f);
  Image b = a;
  b.pixel(4, 4)[1] = std::nanf("");
  b.pixel(0, 8)[0] = infinity;
  const Image map = measure_flip({a, b, ValueKind::linear}).map;
  EXPECT_EQ(*map.pixel(4, 4), 1);
  EXPECT_EQ(*map.pixel(0, 8), 1);
  for (const float value : map.pixels) EXPECT_TRUE(value >= 0 && value <= 1) << value;
  for (const float value : measure_flip({b, b, ValueKind::linear}).map.pixels) EXPECT_EQ(value, 0);
}

// 9 pixels of luminance 1 to 9: the curve takes x to 0.85 of white, so that 9 2^start = x and 5 2^stop = x.
TEST(Flip, ExposuresShowTheBrightestAndTheMedian) {
  Image image(3, 3, 3);
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<float>((i * 4) % 9 + 1);
  const FlipExposures exposures = flip_exposures(image);
  const auto shown = [](float value, float stops) {
    const AcesFraction curve = aces_fraction(value * std::exp2(stops));
    return curve.above / curve.below;
  };
  EXPECT_NEAR(shown(9, exposures.start), 0.85, 1e-5);
  EXPECT_NEAR(shown(5, exposures.stop), 0.85, 1e-5);
  EXPECT_EQ(exposures.count, 2);
  EXPECT_EQ(exposures.stops(0), exposures.start);
  EXPECT_EQ(exposures.stops(1), exposures.stop);
}

TEST(Flip, ABlackReferenceHasExposuresToo) {
  const Image black(4, 4, 3);
  const FlipExposures exposures = flip_exposures(black);
  EXPECT_TRUE(std::isfinite(exposures.start) && std::isfinite(exposures.stop));
  EXPECT_EQ(exposures.count, 2);
}

TEST(FlipFilters, SumUpAsThePaperSays) {
  for (const double pixels_per_degree : {10.0, default_pixels_per_degree, 200.0}) {
    const FlipFilters filters = make_flip_filters(pixels_per_degree);
    const auto sum = [](const HalfKernel& kernel) {
      double total = kernel.weights[0];
      for (std::size_t k = 1; k < kernel.weights.size(); ++k) total += 2 * kernel.weights[k];
      return total;
    };
    EXPECT_NEAR(sum(filters.luminance), 1, 1e-6);
    EXPECT_NEAR(sum(filters.red_green), 1, 1e-6);
    EXPECT_NEAR(sum(filters.smooth), 1, 1e-6);
    EXPECT_NEAR(sum(filters.point), 0, 1e-6);
    EXPECT_NEAR(sum(filters.blue_yellow_wide) * sum(filters.blue_yellow_wide_along) +
                    sum(filters.blue_yellow_narrow) * sum(filters.blue_yellow_narrow_along),
                1, 1e-6);
    double edge = 0;
    for (const float weight : filters.edge.weights) edge += weight;
    EXPECT_NEAR(edge, 1, 1e-6);
    EXPECT_FALSE(filters.edge.is_symmetric);
  }
}

}  // namespace
}  // namespace candil::test
