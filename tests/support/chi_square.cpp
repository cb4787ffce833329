#include "tests/support/chi_square.h"

#include <algorithm>
#include <cmath>

namespace candil::test {
namespace {

/// P(a, x) by its power series; converges fast for x < a + 1 (Abramowitz and Stegun 6.5.29).
double lower_gamma_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (double n = a + 1; term > sum * 1e-16; ++n) {
    term *= x / n;
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Q(a, x) by its continued fraction, evaluated forwards (Lentz); converges fast for x > a + 1 (Abramowitz and
/// Stegun 6.5.31).
double upper_gamma_fraction(double a, double x) {
  double b = x + 1 - a, c = 1e300, d = 1 / b, value = d;
  for (int i = 1; i < 10000; ++i) {
    const double factor = -i * (i - a);
    b += 2;
    d = 1 / (factor * d + b);
    c = b + factor / c;
    value *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return value * std::exp(a * std::log(x) - x - std::lgamma(a));
}

}  // namespace

double chi_square_p_value(double statistic, int degrees_of_freedom) {
  const double a = 0.5 * degrees_of_freedom, x = 0.5 * statistic;
  if (x <= 0) return 1;
  return x < a + 1 ? 1 - lower_gamma_series(a, x) : upper_gamma_fraction(a, x);
}

ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected) {
  constexpr double fewest = 5;  // below, the statistic no longer follows the chi-square distribution
  ChiSquareResult result;
  double pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  const auto add = [&](double seen, double wanted) {
    result.statistic += (seen - wanted) * (seen - wanted) / wanted;
    ++cells;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] <= 0 && observed[i] > 0) return {infinity, 1, 0};
    if (expected[i] >= fewest) {
      add(observed[i], expected[i]);
    } else {
      pooled_observed += observed[i];
      pooled_expected += expected[i];
    }
  }
  if (pooled_expected >= fewest) {
    add(pooled_observed, pooled_expected);
  } else if (pooled_observed > pooled_expected + 30) {  // a Poisson count of mean 5 never reaches 35
    return {infinity, 1, 0};
  }
  result.degrees_of_freedom = std::max(cells - 1, 1);
  result.p_value = chi_square_p_value(result.statistic, result.degrees_of_freedom);
  return result;
}

int SphereGrid::cell_of(Vec3 direction) const {
  const double azimuth = std::atan2(direction.y, direction.x) / (2 * std::numbers::pi);
  const int row = static_cast<int>(rows * 0.5 * (1 - direction.z));
  const int column = static_cast<int>(columns * (azimuth < 0 ? azimuth + 1 : azimuth));
  return std::clamp(row, 0, rows - 1) * columns + std::clamp(column, 0, columns - 1);
}

Vec3 SphereGrid::direction(double row, double column) const {
  const double z = 1 - 2 * row / rows, azimuth = 2 * std::numbers::pi * column / columns;
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return Vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
}

}  // namespace candil::test
