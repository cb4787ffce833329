#include "metrics/student_t.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace candil {
namespace {

constexpr double least = -1000;

/// Stirling's series, after moving x up to where four terms of it are good for 1e-12. (std::lgamma shares a variable
/// among threads.)
double log_gamma(double x) {
  double shift = 0;
  for (; x < 10; ++x) shift += std::log(x);
  const double r = 1 / x, r2 = r * r;
  const double series = r * (1 / 12.0 - r2 * (1 / 360.0 - r2 * (1 / 1260.0 - r2 / 1680)));
  return (x - 0.5) * std::log(x) - x + 0.5 * std::log(2 * std::numbers::pi) + series - shift;
}

/// Continued fraction of the incomplete beta function I_x(a, b) without its factor (Abramowitz and Stegun 26.5.8),
/// evaluated by Lentz's method. Converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  const auto guarded = [](double v) { return std::abs(v) < tiny ? tiny : v; };
  double c = 1, d = 1 / guarded(1 - (a + b) * x / (a + 1)), h = d;
  for (int m = 1; m < 300; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / guarded(1 + even * d), c = guarded(1 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / guarded(1 + odd * d), c = guarded(1 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-12) break;
  }
  return h;
}

/// ln I_x(a, b) for small x.
double log_incomplete_beta(double a, double b, double x) {
  const double log_beta = log_gamma(a) + log_gamma(b) - log_gamma(a + b);
  return a * std::log(x) + b * std::log1p(-x) - std::log(a) - log_beta + std::log(beta_fraction(a, b, x));
}

/// The normal deviate with the same tails as t: Hill 1970, "Algorithm 395: Student's t-Distribution".
double normal_equivalent(double t, double freedom) {
  const double a = freedom - 0.5, b = 48 * a * a, y = a * std::log1p(t * t / freedom);
  const double series = (((-0.4 * y - 3.3) * y - 24) * y - 85.5) / (0.8 * y * y + 100 + b) + y + 3;
  return (series / b + 1) * std::sqrt(y);
}

}  // namespace

double log10_normal_tails(double z) {
  constexpr double far = 30;
  double log_tails;
  if (z < far)
    log_tails = std::log(std::erfc(z / std::numbers::sqrt2));
  else  // 2 phi(z) / z (1 - 1 / z^2)
    log_tails = -z * z / 2 + 0.5 * std::log(2 / std::numbers::pi) - std::log(z) + std::log1p(-1 / (z * z));
  return std::max(least, log_tails / std::numbers::ln10);
}

double log10_student_tails(double t, double freedom) {
  if (!(t < 1e150)) return least;
  constexpr double many = 1e6, enough_for_hill = 30;
  if (!(freedom < many)) return log10_normal_tails(t);
  if (freedom > enough_for_hill) return log10_normal_tails(normal_equivalent(t, freedom));
  // P(|T| >= t) = I_x(freedom / 2, 1 / 2) with x = freedom / (freedom + t^2); from the other side for small t.
  const double a = freedom / 2, b = 0.5, x = freedom / (freedom + t * t);
  if (x < (a + 1) / (a + b + 2)) return std::max(least, log_incomplete_beta(a, b, x) / std::numbers::ln10);
  if (t == 0) return 0;
  return std::log10(-std::expm1(log_incomplete_beta(b, a, t * t / (freedom + t * t))));
}

}  // namespace candil
