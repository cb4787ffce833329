/// Independence of what must be independent: dimensions, pixels and seeds.
#include <gtest/gtest.h>

#include <functional>

#include "core/sampler.h"
#include "tests/support/chi_square.h"

namespace candil {
namespace {

/// Chi-square over an n x n grid of points that should be uniform in the unit square.
double uniform_p_value(int count, const std::function<Vec2(int)>& point, int n = 16) {
  std::vector<double> observed(n * n), expected(n * n, static_cast<double>(count) / (n * n));
  for (int i = 0; i < count; ++i) {
    const Vec2 p = point(i);
    ++observed[static_cast<int>(p.y * n) * n + static_cast<int>(p.x * n)];
  }
  return test::chi_square_test(observed, expected).p_value;
}

constexpr int count = 1 << 14;
glm::uvec2 pixel_of(int i) { return {i % 128, i / 128}; }

TEST(SamplerStatistics, DimensionsOfOnePixelAreIndependent) {
  for (std::uint32_t a = 0; a < 8; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) {
      const double p = uniform_p_value(count, [&](int i) {
        const Sampler sampler({3, 4}, i, 0);
        return Vec2(sampler.sample_2d(a).x, sampler.sample_2d(b).y);
      });
      EXPECT_GT(p, test::significance) << "dimensions " << a << " and " << b;
    }
  }
}

TEST(SamplerStatistics, FirstSampleIsUniformOverPixels) {
  for (std::uint32_t dimension = 0; dimension < 8; ++dimension) {
    const double p = uniform_p_value(count, [&](int i) { return Sampler(pixel_of(i), 0, 0).sample_2d(dimension); });
    EXPECT_GT(p, test::significance) << dimension;
  }
}

TEST(SamplerStatistics, DimensionsOfTheFirstSampleAreIndependent) {
  for (std::uint32_t dimension = 0; dimension < 8; ++dimension) {
    const double p = uniform_p_value(count, [&](int i) {
      const Sampler sampler(pixel_of(i), 0, 0);
      return Vec2(sampler.sample_2d(dimension).x, sampler.sample_2d(dimension + 1).x);
    });
    EXPECT_GT(p, test::significance) << dimension;
  }
}

TEST(SamplerStatistics, NeighbouringPixelsAreIndependent) {
  for (const glm::uvec2 step : {glm::uvec2(1, 0), glm::uvec2(0, 1), glm::uvec2(1, 1)}) {
    const double p = uniform_p_value(count, [&](int i) {
      return Vec2(Sampler(pixel_of(i), 5, 0).sample_2d(2).x, Sampler(pixel_of(i) + step, 5, 0).sample_2d(2).x);
    });
    EXPECT_GT(p, test::significance) << step.x << ", " << step.y;
  }
}

TEST(SamplerStatistics, SeedsAreIndependent) {
  for (const std::uint64_t other : {1ULL, 2ULL, 1ULL << 32, ~0ULL}) {
    const double p = uniform_p_value(count, [&](int i) {
      return Vec2(Sampler(pixel_of(i), 0, 0).sample_2d(0).x, Sampler(pixel_of(i), 0, other).sample_2d(0).x);
    });
    EXPECT_GT(p, test::significance) << other;
  }
}

}  // namespace
}  // namespace candil
