#include "core/tonemap.h"

#include <gtest/gtest.h>

#include "core/color.h"

namespace candil {
namespace {

void expect_near(Vec3 actual, Vec3 expected, float tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
}

TEST(Tonemap, NamesAndKindsMatch) {
  const std::vector<std::string> names = tonemap_names();
  ASSERT_EQ(names.size(), 3u);
  EXPECT_EQ(tonemap_from_name("neutral"), Tonemap::neutral);
  EXPECT_EQ(tonemap_from_name("clamp"), Tonemap::clamp);
  EXPECT_EQ(tonemap_from_name("none"), Tonemap::none);
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(tonemap_from_name(names[i]), static_cast<Tonemap>(i));
  EXPECT_FALSE(tonemap_from_name("Neutral"));
}

// With all channels above 0.08 the offset is F90's 0.04, and below a peak of 0.8 nothing else happens.
TEST(Neutral, TakesTheFresnelOffsetOffOrdinaryColors) {
  expect_near(apply_tonemap(Tonemap::neutral, {0.54f, 0.34f, 0.14f}), {0.50f, 0.30f, 0.10f}, 1e-6f);
}

// A least channel x below 0.08 gives the offset x - 6.25 x^2: for x = 0.04 that is 0.04 - 0.01 = 0.03.
TEST(Neutral, OffsetIsQuadraticForDarkColors) {
  expect_near(apply_tonemap(Tonemap::neutral, {0.50f, 0.20f, 0.04f}), {0.47f, 0.17f, 0.01f}, 1e-6f);
  expect_near(apply_tonemap(Tonemap::neutral, Vec3(0.0f)), Vec3(0.0f), 0.0f);
}

// Grey 1.04: peak after the offset 1, d = 1 - 0.76 = 0.24, new peak 1 - 0.24^2 / (1 + 0.24 - 0.76) = 1 - 0.0576 / 0.48
// = 0.88. Grey stays grey, whatever the desaturation.
TEST(Neutral, CompressesHighlights) { expect_near(apply_tonemap(Tonemap::neutral, Vec3(1.04f)), Vec3(0.88f), 1e-6f); }

// Red (2, 0, 0): no offset, d = 0.24, new peak 1 - 0.0576 / (2 + 0.24 - 0.76) = 0.961081; colour (0.961081, 0, 0);
// g = 1 - 1 / (0.15 (2 - 0.961081) + 1) = 0.134827; mixed with the white of the peak: (0.961081, 0.129580, 0.129580).
TEST(Neutral, DesaturatesBrightColors) {
  expect_near(apply_tonemap(Tonemap::neutral, {2, 0, 0}), {0.961081f, 0.129580f, 0.129580f}, 1e-5f);
}

TEST(Neutral, RisesWithoutEndTowardsWhite) {
  float last = -1;
  for (float grey = 0; grey < 50; grey += 0.01f) {
    const float mapped = apply_tonemap(Tonemap::neutral, Vec3(grey)).y;
    EXPECT_GT(mapped, last) << grey;
    EXPECT_LT(mapped, 1.0f) << grey;
    last = mapped;
  }
  expect_near(apply_tonemap(Tonemap::neutral, Vec3(1e6f, 1e5f, 0)), Vec3(1.0f), 1e-3f);
  expect_near(apply_tonemap(Tonemap::neutral, Vec3(infinity)), Vec3(1.0f), 1e-6f);
}

// Grey 0.8 has a peak of 0.76 after the offset: there the two branches must meet.
TEST(Neutral, IsContinuousWhereCompressionStarts) {
  const float below = apply_tonemap(Tonemap::neutral, Vec3(0.8f - 1e-5f)).x;
  const float above = apply_tonemap(Tonemap::neutral, Vec3(0.8f + 1e-5f)).x;
  EXPECT_NEAR(below, above, 5e-5f);
  EXPECT_NEAR(above, 0.76f, 1e-4f);
}

TEST(Tonemap, ClampCutsAndNoneKeeps) {
  expect_near(apply_tonemap(Tonemap::clamp, {-1, 0.5f, 7}), {0, 0.5f, 1}, 0.0f);
  expect_near(apply_tonemap(Tonemap::none, {-1, 0.5f, 7}), {-1, 0.5f, 7}, 0.0f);
}

// IEC 61966-2-1: linear 0.18 (a grey card) is 1.055 0.18^(1/2.4) - 0.055 = 0.461356, linear 0.002 is 12.92 * 0.002.
TEST(ToDisplay, AppliesExposureThenTheSrgbCurve) {
  Image image(2, 1, 3);
  image.pixels = {0.045f, 0.0005f, 1, 0.25f, 0, 3};
  const Image display = to_display(image, 2, Tonemap::clamp);  // two stops: four times
  EXPECT_NEAR(display.pixel(0, 0)[0], 0.461356f, 1e-5f);
  EXPECT_NEAR(display.pixel(0, 0)[1], 0.02584f, 1e-6f);
  EXPECT_NEAR(display.pixel(0, 0)[2], 1.0f, 1e-6f);
  EXPECT_NEAR(display.pixel(1, 0)[0], 1.0f, 1e-6f);
  EXPECT_EQ(display.pixel(1, 0)[1], 0.0f);
}

// A pixel half covered by a surface of radiance 0.18 holds 0.09 premultiplied: the display colour is that of 0.18.
TEST(ToDisplay, WorksOnColorThatIsNotPremultiplied) {
  Image image(2, 1, 4);
  image.pixels = {0.09f, 0.09f, 0.09f, 0.5f, 0, 0, 0, 0};
  const Image display = to_display(image, 0, Tonemap::clamp);
  EXPECT_NEAR(display.pixel(0, 0)[0], 0.461356f, 1e-5f);
  EXPECT_EQ(display.pixel(0, 0)[3], 0.5f);
  EXPECT_EQ(display.pixel(1, 0)[0], 0.0f);
  EXPECT_EQ(display.pixel(1, 0)[3], 0.0f);
}

TEST(Srgb, CurveAndInverseMeetForEveryByte) {
  for (int i = 0; i < 256; ++i) {
    const float encoded = static_cast<float>(i) / 255;
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(encoded)), encoded, 1e-5f);
  }
}

}  // namespace
}  // namespace candil
