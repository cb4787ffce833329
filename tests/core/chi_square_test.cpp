/// The tool that other tests lean on: p-values against closed forms, and that it can tell right from wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/chi_square.h"

namespace candil::test {
namespace {

TEST(ChiSquare, TwoDegreesOfFreedomAreExponential) {
  for (const double x : {0.1, 1.0, 5.0, 30.0, 100.0}) {
    EXPECT_NEAR(chi_square_p_value(x, 2) / std::exp(-x / 2), 1, 1e-10) << x;
  }
}

TEST(ChiSquare, OneDegreeOfFreedomIsASquaredNormal) {
  for (const double x : {0.5, 1.0, 3.841, 20.0}) {
    EXPECT_NEAR(chi_square_p_value(x, 1) / std::erfc(std::sqrt(x / 2)), 1, 1e-10) << x;
  }
}

TEST(ChiSquare, EvenDegreesOfFreedomArePoissonTails) {
  // Q(n, x) = exp(-x) * sum of x^k / k! for k < n.
  const int n = 200;
  for (const double x : {150.0, 200.0, 260.0}) {
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += std::exp(-x + k * std::log(x) - std::lgamma(k + 1.0));
    EXPECT_NEAR(chi_square_p_value(2 * x, 2 * n) / sum, 1, 1e-8) << x;
  }
}

std::optional<Vec3> uniform_hemisphere(Random& random) {
  const Vec2 u = random.next_2d();
  const float radius = std::sqrt(1 - u.x * u.x);
  return Vec3(radius * std::cos(2 * pi * u.y), radius * std::sin(2 * pi * u.y), u.x);
}

TEST(ChiSquare, AcceptsRightDensity) {
  const auto pdf = [](Vec3 d) { return d.z > 0 ? 1 / (2 * pi) : 0.0f; };
  EXPECT_GT(test_directions(uniform_hemisphere, pdf, 100'000).p_value, 1e-3);
}

TEST(ChiSquare, RejectsWrongShapeWrongScaleAndWrongSupport) {
  const auto tilted = [](Vec3 d) { return d.z > 0 ? (1 + 0.1f * d.x) / (2 * pi) : 0.0f; };
  const auto too_large = [](Vec3 d) { return d.z > 0 ? 1.02f / (2 * pi) : 0.0f; };
  const auto too_small = [](Vec3 d) { return d.z > 0 ? 0.98f / (2 * pi) : 0.0f; };
  const auto cut = [](Vec3 d) { return d.z > 0.5f ? 1 / pi : 0.0f; };
  EXPECT_LT(test_directions(uniform_hemisphere, tilted, 100'000).p_value, significance);
  EXPECT_LT(test_directions(uniform_hemisphere, too_large, 100'000).p_value, significance);
  EXPECT_LT(test_directions(uniform_hemisphere, too_small, 100'000).p_value, significance);
  EXPECT_LT(test_directions(uniform_hemisphere, cut, 100'000).p_value, significance);
}

TEST(ChiSquare, CountsDrawsWithoutResult) {
  const auto half_of_the_time = [](Random& random) -> std::optional<Vec3> {
    const bool is_kept = random.next_1d() < 0.5f;
    const auto direction = uniform_hemisphere(random);
    return is_kept ? direction : std::nullopt;
  };
  const auto pdf = [](Vec3 d) { return d.z > 0 ? 0.5f / (2 * pi) : 0.0f; };
  EXPECT_GT(test_directions(half_of_the_time, pdf, 100'000).p_value, 1e-3);
}

}  // namespace
}  // namespace candil::test
