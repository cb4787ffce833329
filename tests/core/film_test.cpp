/// The fixed tree of additions: the same bits however a render is cut into blocks.
#include "core/film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace candil {
namespace {

/// Magnitudes so far apart that floats added in another order give other bits.
PixelSums sample_at(std::uint32_t index) {
  const float value =
      std::exp2(static_cast<float>(index * 2654435761U % 40) - 20) * (1 + static_cast<float>(index % 13) / 7);
  PixelSums sums{};
  sums.radiance = Vec3(value, 1 / value, value / 3);
  sums.alpha = static_cast<float>(index % 3) / 3;
  sums.radiance_squared = sums.radiance * sums.radiance;
  return sums;
}

bool same_bits(const PixelSums& a, const PixelSums& b) {
  return a.radiance == b.radiance && a.alpha == b.alpha && a.radiance_squared == b.radiance_squared;
}

PixelSums tree_sum(std::uint32_t first, std::uint32_t count) {
  if (count == 1) return sample_at(first);
  PixelSums sum = tree_sum(first, count / 2);
  sum += tree_sum(first + count / 2, count / 2);
  return sum;
}

TEST(PairwiseSum, IsTheBalancedTreeForPowersOfTwo) {
  for (const std::uint32_t count : {1U, 2U, 8U, 64U, 1024U}) {
    PairwiseSum<PixelSums> sum;
    for (std::uint32_t i = 0; i < count; ++i) sum.add(sample_at(i));
    EXPECT_TRUE(same_bits(sum.total(), tree_sum(0, count))) << count;
  }
}

TEST(PairwiseSum, DiffersFromAPlainSumOnThisData) {
  // Otherwise the tests here would prove nothing.
  PairwiseSum<PixelSums> pairwise;
  PixelSums plain{};
  for (std::uint32_t i = 0; i < 64; ++i) pairwise.add(sample_at(i)), plain += sample_at(i);
  EXPECT_FALSE(same_bits(pairwise.total(), plain));
}

TEST(PairwiseSum, IsMoreExactThanAPlainSum) {
  // A million times 0.1: a plain float sum is off by about 1 %, a tree by a few roundings.
  PairwiseSum<PixelSums> sum;
  PixelSums sample{};
  sample.radiance = Vec3(0.1f);
  for (int i = 0; i < 1'000'000; ++i) sum.add(sample);
  EXPECT_NEAR(sum.total().radiance.x / 1e6, 0.1, 1e-7);
}

/// Adds the samples from the film's count on, `block` of them, as a renderer does it.
void add_block(Film& film, std::uint32_t block) {
  film.begin_block();
  PairwiseSum<PixelSums> sum;
  for (std::uint32_t i = 0; i < block; ++i) sum.add(sample_at(film.sample_count() + i));
  film.block_pixel(0, 0) = sum.total();
  film.end_block(block);
}

Film rendered(std::uint32_t samples, std::uint32_t largest_block) {
  Film film(1, 1);
  while (film.sample_count() < samples) {
    std::uint32_t block = std::min(largest_block, next_block_size(film.sample_count(), samples));
    add_block(film, block);
  }
  return film;
}

TEST(Film, SameBitsForEveryBlockSize) {
  for (std::uint32_t samples = 1; samples <= 100; ++samples) {
    PairwiseSum<PixelSums> expected;
    for (std::uint32_t i = 0; i < samples; ++i) expected.add(sample_at(i));
    const PixelSums total = expected.total();
    for (const std::uint32_t largest : {1U, 2U, 8U, 16U}) {
      const Film film = rendered(samples, largest);
      ASSERT_EQ(film.sample_count(), samples);
      const Image mean = film.mean();
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(mean.pixels[c], total.radiance[c] * (1 / static_cast<float>(samples)))
            << samples << " by " << largest;
      }
    }
  }
}

TEST(Film, AnInterruptedRenderContinuesWithTheSameBits) {
  Film film(1, 1);
  while (film.sample_count() < 40) add_block(film, next_block_size(film.sample_count(), 40));
  film.begin_block();  // a block that Ctrl-C ends
  film.block_pixel(0, 0) = sample_at(999);
  film.drop_block();
  while (film.sample_count() < 100) add_block(film, next_block_size(film.sample_count(), 100));
  EXPECT_EQ(film.mean().pixels, rendered(100, 16).mean().pixels);
  EXPECT_EQ(film.variance().pixels, rendered(100, 16).variance().pixels);
}

TEST(Film, BlockSizesArePowersOfTwoThatDivideWhatIsDone) {
  for (std::uint32_t wanted = 1; wanted <= 200; ++wanted) {
    std::uint32_t done = 0;
    while (done < wanted) {
      const std::uint32_t block = next_block_size(done, wanted);
      ASSERT_TRUE(std::has_single_bit(block));
      ASSERT_EQ(done % block, 0U);
      done += block;
    }
    ASSERT_EQ(done, wanted);
  }
}

Film film_of(std::initializer_list<float> values) {
  Film film(2, 1);
  for (const float value : values) {
    film.begin_block();
    for (int x = 0; x < 2; ++x) {
      PixelSums& sums = film.block_pixel(x, 0);
      sums.radiance = Vec3(value, 2 * value, 0);
      sums.radiance_squared = sums.radiance * sums.radiance;
      sums.alpha = 0.5f;
    }
    film.end_block(1);
  }
  return film;
}

TEST(Film, MeanAndVarianceOfTheMean) {
  // 1, 3, 5, 7: mean 4; unbiased variance (9 + 1 + 1 + 9) / 3 = 20 / 3; of the mean of four, 5 / 3.
  const Film film = film_of({1, 3, 5, 7});
  const Image mean = film.mean(), variance = film.variance();
  ASSERT_EQ(mean.channels, 4);
  ASSERT_EQ(variance.channels, 3);
  for (int x = 0; x < 2; ++x) {
    EXPECT_FLOAT_EQ(mean.pixel(x, 0)[0], 4);
    EXPECT_FLOAT_EQ(mean.pixel(x, 0)[1], 8);
    EXPECT_FLOAT_EQ(mean.pixel(x, 0)[2], 0);
    EXPECT_FLOAT_EQ(mean.pixel(x, 0)[3], 0.5f);
    EXPECT_FLOAT_EQ(variance.pixel(x, 0)[0], 5.0f / 3);
    EXPECT_FLOAT_EQ(variance.pixel(x, 0)[1], 20.0f / 3);
    EXPECT_FLOAT_EQ(variance.pixel(x, 0)[2], 0);
  }
  // Red and green are in step, so the luminance's deviation over its mean is that of red: sqrt(5 / 3) / 4.
  EXPECT_NEAR(film.relative_noise(), std::sqrt(5.0f / 3) / 4, 1e-6f);
}

TEST(Film, WithoutSamplesAllIsZero) {
  const Film film(3, 2);
  EXPECT_EQ(film.mean().pixels, std::vector<float>(24, 0));
  EXPECT_EQ(film.variance().pixels, std::vector<float>(18, 0));
  EXPECT_EQ(film.relative_noise(), 0);
}

TEST(Film, OneSampleHasNoVariance) {
  const Film film = film_of({3});
  EXPECT_FLOAT_EQ(film.mean().pixels[0], 3);
  EXPECT_EQ(film.variance().pixels[0], 0);
}

}  // namespace
}  // namespace candil
