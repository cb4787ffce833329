/// Filters against the closed forms of their cumulative distribution and variance.
#include "core/pixel_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace candil {
namespace {

constexpr double radius = 1.5;
// Harris 1978, minimum four-term Blackman-Harris; about the centre, all cosines count positive.
constexpr double a[] = {0.35875, 0.48829, 0.14128, 0.01168};

/// Integral of the window from -radius to x, divided by the whole (2 radius a0).
double blackman_harris_cdf(double x) {
  double sum = a[0] * (x + radius);
  for (int n = 1; n < 4; ++n)
    sum += a[n] * radius / (n * std::numbers::pi) * std::sin(n * std::numbers::pi * x / radius);
  return sum / (2 * radius * a[0]);
}

double gaussian_cdf(double x) {
  const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const double cut = normal(-3);  // 1.5 is three standard deviations
  return (normal(x / 0.5) - cut) / (1 - 2 * cut);
}

double box_cdf(double x) { return x + 0.5; }

struct Case {
  const char* name;
  double (*cdf)(double);
  double variance, reach;
};

double blackman_harris_variance() {
  // Integral of x^2 cos(n pi x / R) over [-R, R] is 4 R^3 (-1)^n / (n pi)^2, of x^2 is 2 R^3 / 3.
  double sum = 1.0 / 3;
  for (int n = 1; n < 4; ++n) sum += 2 * a[n] / a[0] * (n % 2 ? -1 : 1) / std::pow(n * std::numbers::pi, 2);
  return radius * radius * sum;
}

double gaussian_variance() {
  // Truncated at z = 3: 1 - 2 z phi(z) / (2 Phi(z) - 1), times 0.5^2.
  const double density = std::exp(-4.5) / std::sqrt(2 * std::numbers::pi);
  return 0.25 * (1 - 6 * density / std::erf(3 / std::numbers::sqrt2));
}

const Case cases[] = {{"box", box_cdf, 1.0 / 12, 0.5},
                      {"blackman-harris", blackman_harris_cdf, blackman_harris_variance(), radius},
                      {"gaussian", gaussian_cdf, gaussian_variance(), radius}};

TEST(PixelFilter, SamplesInvertTheCumulativeDistribution) {
  for (const Case& c : cases) {
    const PixelFilter filter(filter_from_name(c.name).value());
    for (int i = 0; i < 4096; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / 4096;
      const Vec2 p = filter.sample({u, 1 - u});
      // The table has 256 steps; a straight line between two of them stays within half a step.
      EXPECT_NEAR(c.cdf(p.x), u, 0.5 / 256) << c.name;
      EXPECT_NEAR(p.y, -p.x, 1e-4) << c.name << " is even";
      EXPECT_LE(std::abs(p.x), c.reach) << c.name;
    }
  }
}

TEST(PixelFilter, Variance) {
  for (const Case& c : cases) {
    const PixelFilter filter(filter_from_name(c.name).value());
    double sum = 0;
    constexpr int n = 1 << 16;
    for (int i = 0; i < n; ++i) sum += sqr(filter.sample({(static_cast<float>(i) + 0.5f) / n, 0}).x);
    // The table's last step spreads a thin tail evenly, which widens Blackman-Harris by 1.6 %.
    EXPECT_NEAR(sum / n / c.variance, 1, 0.02) << c.name;
  }
}

TEST(PixelFilter, AxesAreSampledApart) {
  const PixelFilter filter(FilterKind::blackman_harris);
  EXPECT_EQ(filter.sample({0.2f, 0.1f}).x, filter.sample({0.2f, 0.9f}).x);
  EXPECT_EQ(filter.sample({0.2f, 0.7f}).y, filter.sample({0.7f, 0.7f}).x);
}

TEST(PixelFilter, BoxFillsThePixelAndNothingElse) {
  const PixelFilter filter(FilterKind::box);
  EXPECT_EQ(filter.sample({0, 0}), Vec2(-0.5f));
  EXPECT_LT(filter.sample(Vec2(one_minus_epsilon)).x, 0.5f);
}

TEST(PixelFilter, UnknownNamesAreRefused) {
  EXPECT_FALSE(filter_from_name("Box"));
  EXPECT_FALSE(filter_from_name(""));
  EXPECT_FALSE(filter_from_name("mitchell"));
}

}  // namespace
}  // namespace candil
