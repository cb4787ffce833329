#include "core/tonemap_reinhard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/tonemap_samples.h"

namespace candil {
namespace {

using test::expect_near;
using test::linear_values;
using test::row_of;
using test::row_of_greys;

Tonemap reinhard02() { return make_tonemap(TonemapKind::reinhard02); }

// The log-average of 0.01 and 1 is 0.1; the key 0.18 scales by 1.8. The brightest pixel, 1.8, is white by default; the
// other is 0.018 (1 + 0.018 / 1.8^2) / 1.018 = 0.0177800.
TEST(Reinhard02, FollowsThePaper) {
  const std::vector<Vec3> values = linear_values(row_of_greys({0.01f, 1}), reinhard02());
  EXPECT_NEAR(values[0].x, 0.0177800f, 1e-6f);
  EXPECT_NEAR(values[1].x, 1.0f, 1e-6f);
}

// White 2: 1.8 (1 + 1.8 / 4) / 2.8 = 0.932143. Key 0.36: 0.036 (1 + 0.036 / 4) / 1.036 = 0.0350618.
TEST(Reinhard02, HasAKeyAndAWhitePoint) {
  Tonemap tonemap = reinhard02();
  tonemap.white = 2;
  EXPECT_NEAR(linear_values(row_of_greys({0.01f, 1}), tonemap)[1].x, 0.932143f, 1e-5f);
  tonemap.key = 0.36;
  EXPECT_NEAR(linear_values(row_of_greys({0.01f, 1}), tonemap)[0].x, 0.0350618f, 1e-6f);
}

// With the logarithm of a small number in the place of black, 98 black pixels would make the average nearly 0 and all
// others white. The same goes for pixels that are not finite, in their own way.
TEST(Reinhard02, IsNotSpoiledByBlackPixels) {
  std::vector<float> greys(98, 0.0f);
  greys.insert(greys.end(), {0.01f, 1, 1e-30f, std::nanf(""), infinity});
  const std::vector<Vec3> values = linear_values(row_of_greys(greys), reinhard02());
  EXPECT_NEAR(values[98].x, 0.0177800f, 1e-6f);
  EXPECT_NEAR(values[99].x, 1.0f, 1e-6f);
  EXPECT_EQ(values[0], Vec3(0));
}

// Multiplying all light by 1e7 / 3 changes nothing.
TEST(Reinhard02, DoesNotDependOnTheUnit) {
  const std::vector<Vec3> small = linear_values(row_of_greys({0.01f, 0.3f, 1, 3}), reinhard02());
  const std::vector<Vec3> large = linear_values(row_of_greys({1e5f / 3, 1e6f, 1e7f / 3, 1e7f}), reinhard02());
  for (std::size_t i = 0; i < small.size(); ++i) expect_near(large[i], small[i], 1e-5f);
}

// One luminance L: the average is L, scaled 0.18 whatever L; with white 1: 0.18 1.18 / 1.18 = 0.18. Colours keep their
// proportions 4 : 2 : 1.
TEST(Reinhard02, KeepsColors) {
  Tonemap tonemap = reinhard02();
  tonemap.white = 1;
  const Vec3 value = linear_values(row_of({{400, 200, 100}}), tonemap)[0];
  EXPECT_NEAR(0.2126f * value.x + 0.7152f * value.y + 0.0722f * value.z, 0.18f, 1e-5f);
  EXPECT_NEAR(value.x, 4 * value.z, 1e-5f);
  EXPECT_NEAR(value.y, 2 * value.z, 1e-5f);
}

/// Adaptation to the mean luminance, contrast 1.
Tonemap plain_reinhard05() {
  Tonemap tonemap = make_tonemap(TonemapKind::reinhard05);
  tonemap.light = 0, tonemap.contrast = 1;
  return tonemap;
}

// Greys 0, 1, 3 of mean 4/3: responses 0, 1 / (1 + 4/3) = 3/7 and 3 / (3 + 4/3) = 9/13, of which the last becomes
// white: (3/7) / (9/13) = 39/63.
TEST(Reinhard05, FollowsThePaper) {
  const std::vector<Vec3> values = linear_values(row_of_greys({0, 1, 3}), plain_reinhard05());
  EXPECT_EQ(values[0], Vec3(0));
  EXPECT_NEAR(values[1].x, 39.0f / 63, 1e-6f);
  EXPECT_NEAR(values[2].x, 1.0f, 1e-6f);
}

// Intensity log 2 halves the adaptation: responses 1 / (1 + 2/3) = 3/5 and 3 / (3 + 2/3) = 9/11, whose ratio is 33/45.
TEST(Reinhard05, IntensityBrightens) {
  Tonemap tonemap = plain_reinhard05();
  tonemap.intensity = std::log(2.0);
  EXPECT_NEAR(linear_values(row_of_greys({0, 1, 3}), tonemap)[1].x, 33.0f / 45, 1e-6f);
}

// Adaptation to each pixel, contrast 1/2: 1 / (1 + 1 / sqrt(I)) is 1/2 for 1, 2/3 for 4: the ratio is 3/4.
TEST(Reinhard05, AdaptsToEachPixel) {
  Tonemap tonemap = make_tonemap(TonemapKind::reinhard05);
  tonemap.contrast = 0.5;
  EXPECT_NEAR(linear_values(row_of_greys({0, 1, 4}), tonemap)[1].x, 0.75f, 1e-6f);
}

// Greys 1, 10, 100: the average of the logarithm is in the middle, k = 1/2; 0.3 + 0.7 * 2^-1.4 = 0.3 + 0.7 * 0.378929.
// A black pixel has no part in it.
TEST(Reinhard05, ChoosesTheContrast) {
  const Image image = row_of_greys({1, 0, 10, 100});
  const Tonemap automatic = make_tonemap(TonemapKind::reinhard05);
  EXPECT_NEAR(make_photoreceptor(automatic, measure_image(image), image).contrast, 0.565250, 1e-6);
}

// The means of the channels are 1.5, 3 and 6. Adapted to them each by itself, all channels of (1, 2, 4) respond
// 1 / 2.5, and the cast is gone. Adapted to the mean luminance 0.2126 * 1.5 + 0.7152 * 3 + 0.0722 * 6 = 2.8977, blue
// responds 4 / 6.8977 and red 1 / 3.8977: 2.2603 times as much.
TEST(Reinhard05, AdaptsToColor) {
  const Image image = row_of({{1, 2, 4}, {3, 6, 12}, {2, 4, 8}, {0, 0, 0}});
  Tonemap tonemap = plain_reinhard05();
  tonemap.color = 1;
  const Vec3 grey = linear_values(image, tonemap)[0];
  EXPECT_NEAR(grey.x, grey.y, 1e-6f);
  EXPECT_NEAR(grey.x, grey.z, 1e-6f);
  tonemap.color = 0;
  const Vec3 blue = linear_values(image, tonemap)[0];
  EXPECT_NEAR(blue.z / blue.x, 2.2603f, 1e-3f);
}

}  // namespace
}  // namespace candil
