/// The z-test where its outcome is known.
#include "metrics/z_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/student_t.h"
#include "metrics/z_test_levels.h"
#include "tests/metrics/noise_images.h"

namespace candil::test {
namespace {

NoisyImage constant(int width, int height, float value, float variance, std::uint32_t samples) {
  NoisyImage image{Image(width, height, 3), Image(width, height, 3), samples};
  std::ranges::fill(image.mean.pixels, value);
  std::ranges::fill(image.variance.pixels, variance);
  return image;
}

TEST(ZTest, EqualImagesAreNoChange) {
  const NoisyImage a = constant(30, 20, 1, 0.01f, 64);
  EXPECT_EQ(test_images(a, a).p_value, 1);
  EXPECT_EQ(test_images(a, a).pixel_tests, 30u * 20 * 3);
  const NoisyImage exact = constant(30, 20, 1, 0, 64);
  EXPECT_EQ(test_images(exact, exact).p_value, 1);
}

// One pixel of a single one: d = 0.8, its standard error sqrt(2 * 0.01), 10^6 samples make the distribution normal.
// Three tests (channels), of which one stands out, and one size of squares: p is 3 times that of 5.657 deviations,
// rounded up to a sixteenth of a decade.
TEST(ZTest, OnePixelFollowsFromItsDeviation) {
  NoisyImage a = constant(1, 1, 1, 0.01f, 1000000), b = a;
  b.mean.pixel(0, 0)[1] = 1.8f;
  const ZTest test = test_images(a, b);
  const double expected = log10_normal_tails(0.8 / std::sqrt(0.02)) + std::log10(3);
  EXPECT_GE(test.log10_p_value, expected - 1e-3);
  EXPECT_LE(test.log10_p_value, expected + 1 / 16.0 + 1e-3);
  EXPECT_EQ(test.worst.channel, 1);
  EXPECT_NEAR(test.worst.deviation, 5.657, 1e-3);
  EXPECT_NEAR(test.worst.mean_difference, 0.8, 1e-6);
  EXPECT_EQ(test.significant_pixel_tests, 1u);
}

// 1 % brighter everywhere at 10 % of noise: 0.07 deviations for a pixel, but 0.01 / (0.1 sqrt(2)) * 256 = 18 for all.
TEST(ZTest, AChangeThatNoPixelShowsStandsOutInTheSums) {
  const NoisyImage a = constant(256, 256, 1, 0.01f, 64), b = constant(256, 256, 1.01f, 0.01f, 64);
  const ZTest test = test_images(a, b);
  EXPECT_LT(test.log10_p_value, -60);
  EXPECT_EQ(test.significant_pixel_tests, 0u);
  EXPECT_EQ(test.worst.region.width, 256);
  EXPECT_NEAR(test.worst.deviation, 18.1, 0.1);
}

// Only one square of 16 pixels has changed, by 0.6 deviations each: 9.6 for the square, and less for larger ones. The
// bound on p is 2 exp(-46), 1e-19.7, before corrections by 13 * 10 squares, 3 channels and 9 sizes.
TEST(ZTest, TellsWhere) {
  NoisyImage a = constant(200, 150, 1, 0.005f, 256), b = a;
  for (int y = 112; y < 128; ++y)
    for (int x = 64; x < 80; ++x)
      for (int c = 0; c < 3; ++c) b.mean.pixel(x, y)[c] -= 0.06f;
  const ZTest test = test_images(a, b);
  EXPECT_LT(test.log10_p_value, -12);
  EXPECT_EQ(test.worst.region.x, 64);
  EXPECT_EQ(test.worst.region.y, 112);
  EXPECT_EQ(test.worst.region.width, 16);
  EXPECT_LT(test.worst.deviation, -9);
}

// Of 2 + 2 samples there are 6 deals, of 4 + 4 there are 70: no p below 2/6 and 2/70 however far apart the pixels are.
// Of 64 + 64 there are 2e37.
TEST(ZTest, FewSamplesProveNothingByThemselves) {
  for (const std::uint32_t samples : {2u, 4u})
    EXPECT_EQ(test_images(constant(1, 1, 1, 0, samples), constant(1, 1, 2, 0, samples)).p_value, 1) << samples;
  EXPECT_LT(test_images(constant(1, 1, 1, 0, 64), constant(1, 1, 2, 0, 64)).p_value, 1e-6);
  // Many pixels together do: 256 that all differ to the same side are 16 deviations.
  EXPECT_LT(test_images(constant(16, 16, 1, 0, 2), constant(16, 16, 2, 0, 2)).p_value, 1e-6);
}

// A pixel of 16 samples that have missed what one sample in 100 sees, beside one of many that have not.
TEST(ZTest, SamplesThatHaveMissedRareLightAreNotCertain) {
  const NoisyImage few = constant(1, 1, 1, 0, 16), many = constant(1, 1, 2, 100.0f / 100000, 100000);
  EXPECT_GT(test_images(few, many).p_value, 0.1);
}

TEST(ZTest, RoundingIsNoChange) {
  const NoisyImage a = constant(64, 64, 1, 0, 64), b = constant(64, 64, 1.00001f, 0, 64);
  EXPECT_EQ(test_images(a, b).p_value, 1);
  const NoisyImage half = constant(64, 64, 1.0004f, 0, 64);
  EXPECT_LT(test_images(a, half).p_value, 1e-6);
  EXPECT_EQ(test_images(a, half, {5e-4f}).p_value, 1);
}

TEST(ZTest, ValuesThatAreNotFiniteAreChangesAndVariancesNoExcuse) {
  const NoisyImage a = constant(8, 8, 1, 0.01f, 64);
  NoisyImage b = a;
  b.mean.pixel(3, 3)[0] = std::nanf("");
  EXPECT_LT(test_images(a, b).log10_p_value, -900);
  EXPECT_EQ(test_images(b, b).p_value, 1);
  NoisyImage blind = constant(8, 8, 2, 0.01f, 64);
  std::ranges::fill(blind.variance.pixels, infinity);
  EXPECT_LT(test_images(a, blind).p_value, 1e-6);
}

TEST(ZTest, UnselectedPixelsDoNotMatter) {
  const NoisyImage a = constant(8, 8, 1, 0.01f, 64);
  NoisyImage b = a;
  b.mean.pixel(3, 3)[0] = 9;
  PixelSelection selection(8, 8);
  selection.keep(std::vector<Region>{{4, 0, 4, 8}});
  const ZTest test = measure_z_test({a.mean, b.mean, ValueKind::linear}, a.noise(), b.noise(), selection);
  EXPECT_EQ(test.p_value, 1);
  EXPECT_EQ(test.pixel_tests, 32u * 3);
}

// Benjamini and Hochberg: 1000 tests, the smallest p-values 10^-4 (once) and 10^-3.5 (twice more):
// min(10^-4 1000 / 1, 10^-3.5 1000 / 3) = min(0.1, 0.105) = 0.1; with ten of the latter 10^-3.5 1000 / 11 = 0.0287.
TEST(LevelTests, AdjustsForTheNumberOfTests) {
  const auto place = [] { return ZTest::Place{}; };
  LevelTests few(1), many(1);
  for (int i = 0; i < 1000; ++i) few.count(0), many.count(0);
  few.add(0, -4, place), few.add(0, -3.5, place), few.add(0, -3.5, place);
  EXPECT_NEAR(few.result().p_value, 0.1, 1e-9);
  many.add(0, -4, place);
  for (int i = 0; i < 10; ++i) many.add(0, -3.5, place);
  EXPECT_NEAR(many.result().p_value, std::pow(10, -3.5) * 1000 / 11, 1e-9);
}

TEST(LevelTests, MergedInAnyPartsAreTheSame) {
  const auto place = [] { return ZTest::Place{}; };
  LevelTests whole(2), first(2), second(2);
  for (int i = 0; i < 100; ++i) {
    LevelTests& part = i < 40 ? first : second;
    for (LevelTests* tests : {&whole, &part}) tests->count(i % 2), tests->add(i % 2, -3 - i * 0.1, place);
  }
  first.merge(second);
  EXPECT_EQ(first.result().log10_p_value, whole.result().log10_p_value);
  EXPECT_EQ(first.result().significant_pixel_tests, whole.result().significant_pixel_tests);
}

}  // namespace
}  // namespace candil::test
