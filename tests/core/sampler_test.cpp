/// Structure of the Owen-scrambled Sobol points, which scrambling must keep exactly.
#include "core/sampler.h"

#include <gtest/gtest.h>

#include <vector>

namespace candil {
namespace {

struct Stream {
  glm::uvec2 pixel;
  std::uint64_t seed;
  std::uint32_t dimension;
};

const std::vector<Stream> streams = {
    {{0, 0}, 0, 0}, {{0, 0}, 0, 1}, {{1, 0}, 0, 0}, {{0, 1}, 0, 7}, {{1919, 1079}, 1, 3}, {{7, 9}, ~0ULL, 250},
};

/// A (0, k, 2)-net in base 2: of 2^k points, every box of the kind 2^-a x 2^-(k-a) holds exactly one.
void expect_net(const Stream& stream, std::uint32_t first_sample, int k) {
  const std::uint32_t count = 1U << k;
  for (int a = 0; a <= k; ++a) {
    std::vector<int> hits(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec2 p = Sampler(stream.pixel, first_sample + i, stream.seed).sample_2d(stream.dimension);
      const auto column = static_cast<std::uint32_t>(p.x * static_cast<float>(1U << a));
      const auto row = static_cast<std::uint32_t>(p.y * static_cast<float>(1U << (k - a)));
      ++hits[(row << a) + column];
    }
    for (const int n : hits) ASSERT_EQ(n, 1) << "boxes of 2^-" << a << " x 2^-" << k - a << ", from " << first_sample;
  }
}

TEST(Sampler, FirstSamplesFormNets) {
  for (const Stream& stream : streams) {
    for (int k = 0; k <= 10; ++k) expect_net(stream, 0, k);
  }
}

TEST(Sampler, EveryAlignedBlockOfSamplesIsANet) {
  // What makes blocks of a shared or resumed render as good as those of a plain one.
  for (const Stream& stream : streams) {
    for (const std::uint32_t block : {1U, 2U, 5U, 1000U}) expect_net(stream, block << 6, 6);
  }
}

TEST(Sampler, StaysBelowOne) {
  EXPECT_EQ(to_unit_float(~0U), one_minus_epsilon);
  EXPECT_EQ(to_unit_float(0), 0.0f);
}

TEST(Sampler, SecondDimensionIsTheSobolSequence) {
  // Sobol's second dimension has the direction numbers of Pascal's triangle modulo 2: v_0 = 0.1, v_1 = 0.11,
  // v_2 = 0.101, v_3 = 0.1111 in binary; a point is the exclusive or of those of the index's bits.
  const std::uint32_t directions[] = {0x80000000U, 0xc0000000U, 0xa0000000U, 0xf0000000U, 0x88000000U};
  for (std::uint32_t index = 0; index < 32; ++index) {
    std::uint32_t expected = 0;
    for (int bit = 0; bit < 5; ++bit) {
      if ((index >> bit) & 1) expected ^= directions[bit];
    }
    EXPECT_EQ(reverse_bits(sobol_second_dimension_reversed(index)), expected) << index;
  }
}

TEST(Sampler, ScramblingKeepsWhatLowerBitsShare) {
  // Two values that agree in their lowest n bits agree there after the permutation, and differ in bit n if they did
  // before.
  for (std::uint32_t seed : {0U, 1U, 0x9e3779b9U, ~0U}) {
    for (std::uint32_t x = 0; x < 200; ++x) {
      for (int n = 0; n < 32; ++n) {
        const std::uint32_t y = x ^ (1U << n);
        const std::uint32_t difference = laine_karras_permutation(x, seed) ^ laine_karras_permutation(y, seed);
        ASSERT_EQ(difference & ((2U << n) - 1), 1U << n) << x << " bit " << n;
      }
    }
  }
}

TEST(Sampler, FourPointsAtOnceAreTheSameAsOneByOne) {
  for (std::uint32_t index = 0; index < 300; ++index) {
    const Sampler sampler({index % 7, 1000 - index}, index * 2654435761U, 42);
    const FourPoints four = sampler.sample_four_2d(index);
    for (std::uint32_t i = 0; i < 4; ++i) ASSERT_EQ(four[i], sampler.sample_2d(index + i)) << index << ", " << i;
  }
}

TEST(Sampler, EightSamplersAtOnceAreTheSameAsOneByOne) {
  for (std::uint32_t index = 0; index < 300; ++index) {
    std::vector<Sampler> one;
    for (std::uint32_t i = 0; i < 8; ++i) one.push_back({{index + i / 3, 1000 - index}, i * 2654435761U, index});
    const auto [x, y] = Sampler::sample_2d({one[0], one[1], one[2], one[3], one[4], one[5], one[6], one[7]}, index);
    for (std::size_t i = 0; i < 8; ++i) ASSERT_EQ(Vec2(x[i], y[i]), one[i].sample_2d(index)) << index << ", " << i;
  }
}

}  // namespace
}  // namespace candil
