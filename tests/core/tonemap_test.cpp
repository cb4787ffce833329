#include "core/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/color.h"
#include "core/tonemap_curves.h"
#include "tests/core/tonemap_samples.h"

namespace candil {
namespace {

using test::display_values;
using test::expect_near;
using test::linear_value;
using test::linear_values;
using test::row_of;
using test::row_of_greys;

const Tonemap neutral = make_tonemap(TonemapKind::neutral);

TEST(Tonemap, NamesAndKindsMatch) {
  const std::vector<std::string> names = tonemap_names();
  ASSERT_EQ(names.size(), 11u);
  EXPECT_EQ(names.front(), "neutral");
  EXPECT_EQ(tonemap_from_name("equalize-clamp"), TonemapKind::equalize_clamp);
  EXPECT_EQ(tonemap_from_name("clamp-gamma"), TonemapKind::clamp_gamma);
  EXPECT_EQ(tonemap_from_name("none"), TonemapKind::none);
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(tonemap_from_name(names[i]), static_cast<TonemapKind>(i));
    EXPECT_EQ(tonemap_name(static_cast<TonemapKind>(i)), names[i]);
    EXPECT_FALSE(tonemap_summary(static_cast<TonemapKind>(i)).empty());
  }
  EXPECT_FALSE(tonemap_from_name("Neutral"));
}

TEST(Tonemap, DefaultsAreThoseOfTheReportAndThePapers) {
  EXPECT_EQ(make_tonemap(TonemapKind::clamp).white, 1);
  EXPECT_EQ(make_tonemap(TonemapKind::equalize_clamp).share, 0.78);
  EXPECT_EQ(make_tonemap(TonemapKind::gamma).gamma, 2.2);
  EXPECT_EQ(make_tonemap(TonemapKind::clamp_gamma).share, 0.86);
  EXPECT_EQ(make_tonemap(TonemapKind::clamp_gamma).gamma, 2.2);
  EXPECT_EQ(make_tonemap(TonemapKind::reinhard02).key, 0.18);
  EXPECT_EQ(make_tonemap(TonemapKind::reinhard05).light, 1);
}

// With all channels above 0.08 the offset is F90's 0.04, and below a peak of 0.8 nothing else happens.
TEST(Neutral, TakesTheFresnelOffsetOffOrdinaryColors) {
  expect_near(linear_value({0.54f, 0.34f, 0.14f}, neutral), {0.50f, 0.30f, 0.10f}, 1e-6f);
}

// A least channel x below 0.08 gives the offset x - 6.25 x^2: for x = 0.04 that is 0.04 - 0.01 = 0.03.
TEST(Neutral, OffsetIsQuadraticForDarkColors) {
  expect_near(linear_value({0.50f, 0.20f, 0.04f}, neutral), {0.47f, 0.17f, 0.01f}, 1e-6f);
  expect_near(linear_value(Vec3(0.0f), neutral), Vec3(0.0f), 0.0f);
}

// Grey 1.04: peak after the offset 1, d = 1 - 0.76 = 0.24, new peak 1 - 0.24^2 / (1 + 0.24 - 0.76) = 1 - 0.0576 / 0.48
// = 0.88. Grey stays grey, whatever the desaturation.
TEST(Neutral, CompressesHighlights) { expect_near(linear_value(Vec3(1.04f), neutral), Vec3(0.88f), 1e-6f); }

// Red (2, 0, 0): no offset, d = 0.24, new peak 1 - 0.0576 / (2 + 0.24 - 0.76) = 0.961081; colour (0.961081, 0, 0);
// g = 1 - 1 / (0.15 (2 - 0.961081) + 1) = 0.134827; mixed with the white of the peak: (0.961081, 0.129580, 0.129580).
TEST(Neutral, DesaturatesBrightColors) {
  expect_near(linear_value({2, 0, 0}, neutral), {0.961081f, 0.129580f, 0.129580f}, 1e-5f);
}

TEST(Neutral, RisesWithoutEndTowardsWhite) {
  double last = -1;
  for (int i = 0; i < 5000; ++i) {
    const double grey = 0.01 * i;
    const double mapped = neutral_tonemap(DVec3(grey)).y;
    EXPECT_GT(mapped, last) << grey;
    EXPECT_LT(mapped, 1) << grey;
    last = mapped;
  }
  expect_near(linear_value(Vec3(1e6f, 1e5f, 0), neutral), Vec3(1.0f), 1e-3f);
  expect_near(linear_value(Vec3(infinity), neutral), Vec3(1.0f), 1e-6f);
}

// Grey 0.8 has a peak of 0.76 after the offset: there the two branches must meet.
TEST(Neutral, IsContinuousWhereCompressionStarts) {
  const float below = linear_value(Vec3(0.8f - 1e-5f), neutral).x;
  const float above = linear_value(Vec3(0.8f + 1e-5f), neutral).x;
  EXPECT_NEAR(below, above, 5e-5f);
  EXPECT_NEAR(above, 0.76f, 1e-4f);
}

TEST(Clamp, CutsAtWhite) {
  expect_near(linear_value({-1, 0.5f, 7}, make_tonemap(TonemapKind::clamp)), {0, 0.5f, 1}, 1e-6f);
  Tonemap four = make_tonemap(TonemapKind::clamp);
  four.white = 4;
  expect_near(linear_value({1, 3, 9}, four), {0.25f, 0.75f, 1}, 1e-6f);
}

TEST(None, KeepsWhatADisplayCanShow) {
  expect_near(linear_value({-1, 0.5f, 7}, make_tonemap(TonemapKind::none)), {0, 0.5f, 1}, 1e-6f);
}

// The largest channel is 4, wherever it is; what is not finite does not count.
TEST(Equalize, DividesByTheLargestValue) {
  const Image image = row_of({{1, 2, 3}, {0, 4, 0}, {std::nanf(""), 9, 9}, {infinity, 0, 0}});
  const std::vector<Vec3> values = linear_values(image, make_tonemap(TonemapKind::equalize));
  expect_near(values[0], {0.25f, 0.5f, 0.75f}, 1e-6f);
  expect_near(values[1], {0, 1, 0}, 1e-6f);
  expect_near(values[2], {0, 1, 1}, 1e-6f);
  expect_near(values[3], {1, 0, 0}, 1e-6f);
}

// 0.78 of 100 becomes white: 39 is half of that.
TEST(EqualizeClamp, MakesAShareOfTheLargestValueWhite) {
  const Image image = row_of_greys({39, 78, 90, 100});
  const std::vector<Vec3> values = linear_values(image, make_tonemap(TonemapKind::equalize_clamp));
  EXPECT_NEAR(values[0].x, 0.5f, 1e-6f);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(values[i].x, 1.0f, 1e-6f) << i;
}

// The curve replaces that of sRGB: 0.25^(1/2) = 0.5 is stored. With 2.2, 0.5 becomes 0.729740 (log 0.5 / 2.2 =
// -0.315067).
TEST(Gamma, IsStoredAsItIs) {
  Tonemap square_root = make_tonemap(TonemapKind::gamma);
  square_root.gamma = 2;
  expect_near(display_values(row_of({{0.25f, 0, 9}}), square_root)[0], {0.5f, 0, 1}, 1e-6f);
  expect_near(display_values(row_of_greys({0.5f}), make_tonemap(TonemapKind::gamma))[0], Vec3(0.729740f), 1e-5f);
  square_root.white = 4;
  expect_near(display_values(row_of_greys({1}), square_root)[0], Vec3(0.5f), 1e-6f);
}

// Of 1e7, 8.6e6 becomes white; 4.3e6 is half of that: 0.5^(1/2.2) = 0.729740. With gamma 1 it is stored as 0.5.
TEST(ClampGamma, MakesAShareOfTheLargestValueWhite) {
  const Image image = row_of_greys({4.3e6f, 8.6e6f, 1e7f});
  const std::vector<Vec3> values = display_values(image, make_tonemap(TonemapKind::clamp_gamma));
  EXPECT_NEAR(values[0].x, 0.729740f, 1e-5f);
  EXPECT_NEAR(values[1].x, 1.0f, 1e-6f);
  EXPECT_NEAR(values[2].x, 1.0f, 1e-6f);
  Tonemap plain = make_tonemap(TonemapKind::clamp_gamma);
  plain.gamma = 1;
  EXPECT_NEAR(display_values(image, plain)[0].x, 0.5f, 1e-6f);
}

// IEC 61966-2-1: linear 0.18 (a grey card) is 1.055 0.18^(1/2.4) - 0.055 = 0.461356, linear 0.002 is 12.92 * 0.002.
TEST(ToDisplay, AppliesExposureThenTheSrgbCurve) {
  const Image image = row_of({{0.045f, 0.0005f, 1}, {0.25f, 0, 3}});
  const std::vector<Vec3> values = display_values(image, make_tonemap(TonemapKind::clamp), 2);  // two stops: four times
  expect_near(values[0], {0.461356f, 0.02584f, 1}, 1e-5f);
  expect_near(values[1], {1, 0, 1}, 1e-6f);
}

// Measured without the exposure, the largest value is 4, and one stop shows 2 * 1 / 4.
TEST(ToDisplay, ExposureIsNotCancelledByWhatIsMeasured) {
  const std::vector<Vec3> values = linear_values(row_of_greys({1, 4}), make_tonemap(TonemapKind::equalize), 1);
  EXPECT_NEAR(values[0].x, 0.5f, 1e-6f);
  EXPECT_NEAR(values[1].x, 1.0f, 1e-6f);
}

// A pixel half covered by a surface of radiance 0.18 holds 0.09 premultiplied: the display colour is that of 0.18.
TEST(ToDisplay, WorksOnColorThatIsNotPremultiplied) {
  Image image(2, 1, 4);
  image.pixels = {0.09f, 0.09f, 0.09f, 0.5f, 0, 0, 0, 0};
  const Image display = to_display(image, 0, make_tonemap(TonemapKind::clamp));
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
