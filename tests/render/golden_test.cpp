// What a comparison with a golden image finds, on pictures of known noise.
#include "tests/render/golden.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "io/image_file.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {
namespace {

constexpr int side = 16;

/// Radiance 1 with a normal spread of 3 %.
Image noisy_image(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> noise(1, 0.03f);
  Image image(side, side, 3);
  for (float& value : image.pixels) value = noise(random);
  return image;
}

const Golden golden = make_golden(noisy_image);

TEST(GoldenDeviation, OfTheExampleIsNothingButNoise) {
  const Deviation found = deviation(golden, noisy_image(0));
  EXPECT_EQ(found.paired, 0);
  EXPECT_TRUE(is_within_limits(found));
}

TEST(GoldenDeviation, OfAnotherSeedIsWithinTheLimits) {
  for (std::uint64_t seed = 101; seed <= 120; ++seed)
    EXPECT_TRUE(is_within_limits(deviation(golden, noisy_image(seed)))) << seed;
}

// L / (1 + L) has the slope 1/4 at 1: 5 % of L are 5 / 3 of the spread in each of 64 pixels, 13 standard deviations of
// their mean before that of the replicates is counted.
TEST(GoldenDeviation, TellsTheBlockThatIsTooBright) {
  Image image = noisy_image(101);
  for (int y = 8; y < 16; ++y)
    for (int x = 0; x < 8; ++x) image.pixel(x, y)[1] *= 1.05f;
  const Deviation found = deviation(golden, image);
  EXPECT_GT(found.block, block_limit);
  EXPECT_EQ(found.where, "pixels from (0, 8), channel G");
}

// 0.5001 is stored as 0.5, which is off by 0.2 of the least spread in each of 256 pixels: 3.2 of it over all of them.
TEST(GoldenDeviation, LeavesOutWhatIsRounded) {
  const auto constant = [](float compressed) {
    Image image(side, side, 3);
    image.pixels.assign(image.pixels.size(), compressed / (1 - compressed));
    return image;
  };
  const Golden flat = make_golden([&](std::uint64_t) { return constant(0.5001f); });
  ASSERT_EQ(flat.mean.pixels[0], 0.5f);
  const Deviation found = deviation(flat, constant(0.5001f));
  EXPECT_EQ(found.image, 0);
  EXPECT_EQ(found.block, 0);
  EXPECT_FALSE(is_within_limits(deviation(flat, constant(0.502f))));
}

// 0.75 / 1.75 is 0.071 below 1 / 2: 9.5 times the spread. In turns of another channel, so that no mean moves far.
TEST(GoldenDeviation, CountsOutliers) {
  Image image = noisy_image(101);
  constexpr int outliers = 13;  // 5 % of 256
  for (int i = 0; i < outliers; ++i) image.pixels[3 * 19 * i + i % 3] = 0.75f;
  const Deviation found = deviation(golden, image);
  EXPECT_NEAR(found.outlier_share * side * side, outliers, 1.5) << "one by chance";
  EXPECT_GT(found.outlier_share, outlier_limit);
  EXPECT_LT(found.image, image_limit);
  EXPECT_LT(found.block, block_limit);
}

// 100 differences that are all alike: their sum is 100 of them, the root of the sum of squares 10 of them. A mean over
// noise does not see them.
TEST(GoldenDeviation, PairsPixelsWithTheExample) {
  Image image = noisy_image(0);
  for (int i = 0; i < 100; ++i) image.pixels[3 * i] *= 1.02f;
  const Deviation found = deviation(golden, image);
  EXPECT_GT(found.paired, 9.5);
  EXPECT_LE(found.paired, 10);
  EXPECT_LT(found.image, image_limit);
  EXPECT_LT(found.block, block_limit);
}

TEST(GoldenDeviation, OfWhatIsNotFiniteIsAnError) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), infinity, -1.0f}) {
    Image image = noisy_image(101);
    image.pixels[100] = bad;
    EXPECT_THROW(deviation(golden, image), std::runtime_error) << bad;
    EXPECT_THROW(make_golden([&](std::uint64_t) { return image; }), std::runtime_error) << bad;
  }
  EXPECT_THROW(deviation(golden, Image(side, side + 1, 3)), std::runtime_error) << "size";
}

// One replicate is blinding in a pixel: cut, it moves the mean by no more than the limit's distance over 16.
TEST(GoldenImage, IsNotRuledByOneBrightSample) {
  const Golden bright = make_golden([](std::uint64_t seed) {
    Image image = noisy_image(seed);
    if (seed == 3) image.pixels[0] = 1e6f;
    return image;
  });
  EXPECT_EQ(bright.limit.pixels[0], golden.limit.pixels[0]);
  EXPECT_LT(bright.limit.pixels[0], 0.6f);
  EXPECT_LT(bright.mean.pixels[0], golden.mean.pixels[0] + (0.6f - 0.5f) / golden_replicates + 0.003f);
}

TEST(GoldenImage, IsReadAsItWasWritten) {
  const TemporaryFolder folder;
  write_golden(folder / "golden.exr", golden);
  const Golden read = read_golden(folder / "golden.exr");
  EXPECT_EQ(read.mean.pixels, golden.mean.pixels);
  EXPECT_EQ(read.spread.pixels, golden.spread.pixels);
  EXPECT_EQ(read.limit.pixels, golden.limit.pixels);
  EXPECT_EQ(read.example.pixels, golden.example.pixels);
  EXPECT_EQ(read.example.height, side);
  write_image(folder / "other.exr", Image(side, side + 1, 3), false, {});
  EXPECT_THROW(read_golden(folder / "other.exr"), std::runtime_error);
}

}  // namespace
}  // namespace candil::test
