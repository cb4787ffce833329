// The sign test on pictures of known noise: blind to what is exchangeable, sharp where most of it cancels.
#include "metrics/sign_test.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace candil::test {
namespace {

constexpr float no_rounding = 0;

/// Mean 1, exponential: as skewed as the noise of renders.
Image noise(std::uint64_t seed, int side = 64) {
  std::mt19937_64 random(seed);
  std::exponential_distribution<float> distribution(1);
  Image image(side, side, 3);
  for (float& value : image.pixels) value = distribution(random);
  return image;
}

SignTest test(const Image& a, const Image& b, float rounding = no_rounding) {
  return measure_sign_test({a, b, ValueKind::linear}, PixelSelection(a.width, a.height), rounding);
}

TEST(SignTest, FindsNothingInEqualImages) {
  const Image image = noise(1);
  EXPECT_EQ(test(image, image).p_value, 1);
}

// The p-value is an upper bound: 1000 pairs of nothing but noise have p < 0.01 in fewer than 10 cases on average, and
// in more than 25 with a probability below 1e-5 (Poisson).
TEST(SignTest, RarelyTakesNoiseForAChange) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed)
    alarms += test(noise(2 * seed, 16), noise(2 * seed + 1, 16)).p_value < 0.01;
  EXPECT_LE(alarms, 25);
}

// All 4096 differences of a channel are 0.01 / 2.01 of one sign: z = 64, log10 p below -800.
TEST(SignTest, FindsOnePercentWhereTheNoiseIsTheSame) {
  const Image a = noise(1);
  Image b = a;
  for (float& value : b.pixels) value *= 1.01f;
  const SignTest found = test(a, b);
  EXPECT_NEAR(found.z, 64, 0.01);
  EXPECT_LT(found.log10_p_value, -800);
  EXPECT_EQ(found.region.width, 64);
}

// One path in four turns another way, up as often as down: 16 x 16 pixels of 2 % stand out all the same, in their
// place. z = 16 there, less what the others spoil.
TEST(SignTest, FindsAChangeAmongPathsThatTurnedAnotherWay) {
  const Image a = noise(1), other = noise(2);
  Image b = a;
  for (std::size_t i = 0; i < b.pixels.size(); i += 12) b.pixels[i] = other.pixels[i];
  EXPECT_GT(test(a, b).p_value, 0.001);
  for (int y = 16; y < 32; ++y)
    for (int x = 32; x < 48; ++x) b.pixel(x, y)[1] *= 1.02f;
  const SignTest found = test(a, b);
  EXPECT_LT(found.log10_p_value, -30);
  EXPECT_EQ(found.channel, 1);
  EXPECT_EQ(found.region.x, 32);
  EXPECT_EQ(found.region.y, 16);
}

TEST(SignTest, LeavesOutRounding) {
  const Image a = noise(1);
  Image b = a;
  for (float& value : b.pixels) value *= 1.0004f;
  EXPECT_EQ(test(a, b, 0x1p-10f).p_value, 1);
  EXPECT_LT(test(a, b, 1e-4f).log10_p_value, -800);
}

TEST(SignTest, LeavesOutWhatIsNotFinite) {
  const Image a = noise(1);
  Image b = a;
  b.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  b.pixels[6] = std::numeric_limits<float>::infinity();
  b.pixels[7] = -1;
  EXPECT_EQ(test(a, b).p_value, 1);
}

// Sizes that are no powers of two, down to a single pixel (z = 1 at the most: no evidence).
TEST(SignTest, TakesAnySize) {
  for (const int side : {1, 2, 3, 5, 17}) {
    const Image a = noise(1, side);
    Image b = a;
    for (float& value : b.pixels) value *= 1.01f;
    const SignTest found = test(a, b);
    EXPECT_NEAR(found.z, side, 0.01);
    EXPECT_EQ(found.p_value<0.01, side> 3) << side;
  }
}

}  // namespace
}  // namespace candil::test
