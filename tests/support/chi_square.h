/// Pearson's chi-square test: do samples follow the density that they claim to have?
#pragma once

#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/math.h"

namespace candil::test {

/// A test fails below this p-value. Even a hundred tests together fail a right program less than once in a million
/// choices of seed (and seeds are fixed, so that a run can be repeated).
inline constexpr double significance = 1e-8;

struct ChiSquareResult {
  double statistic = 0;
  int degrees_of_freedom = 0;
  double p_value = 0;  ///< Probability that right samples deviate at least as much.
};

/// Upper tail of the chi-square distribution: the regularised incomplete gamma function Q(degrees / 2, statistic / 2).
double chi_square_p_value(double statistic, int degrees_of_freedom);

/// `observed` counts against `expected` ones (as long, not negative). Cells that expect fewer than 5 are pooled; a
/// sample where none was expected gives p = 0.
ChiSquareResult chi_square_test(std::span<const double> observed, std::span<const double> expected);

/// Independent uniform numbers (stratified ones would fit too well to be tested like this).
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  float next_1d() { return static_cast<float>(engine_() >> 8) * 0x1p-24f; }
  Vec2 next_2d() {
    const float x = next_1d();
    return {x, next_1d()};
  }

 private:
  std::mt19937 engine_;
};

/// Cells of equal solid angle: rows in cos(theta) about +Z, columns in azimuth.
struct SphereGrid {
  int rows = 24, columns = 48;

  int cell_of(Vec3 direction) const;
  Vec3 direction(double row, double column) const;  ///< Fractional: (0, 0) is a corner of cell 0.
  double cell_solid_angle() const { return 4 * std::numbers::pi / (rows * columns); }
};

namespace detail {

/// Integral over [x0, x1] x [y0, y1] by 3 x 3 Gauss points, halved where the halves disagree with the whole.
template <class Function>
double integrate(const Function& f, double x0, double y0, double x1, double y1, double tolerance, int depth) {
  const auto gauss = [&](double ax, double ay, double bx, double by) {
    constexpr double node[] = {-0.7745966692414834, 0, 0.7745966692414834}, weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double x = 0.5 * (ax + bx + node[i] * (bx - ax)), y = 0.5 * (ay + by + node[j] * (by - ay));
        sum += weight[i] * weight[j] * f(x, y);
      }
    }
    return sum * (bx - ax) * (by - ay);
  };
  const double mx = 0.5 * (x0 + x1), my = 0.5 * (y0 + y1);
  const double whole = gauss(x0, y0, x1, y1);
  const double parts = gauss(x0, y0, mx, my) + gauss(mx, y0, x1, my) + gauss(x0, my, mx, y1) + gauss(mx, my, x1, y1);
  // The first level is always split: a narrow peak may hide between the points of a coarse grid. Densities are floats:
  // parts per million are their rounding.
  if (depth <= 0 || (depth <= 5 && std::abs(parts - whole) < tolerance + 1e-6 * parts)) return parts;
  return integrate(f, x0, y0, mx, my, tolerance / 4, depth - 1) +
         integrate(f, mx, y0, x1, my, tolerance / 4, depth - 1) +
         integrate(f, x0, my, mx, y1, tolerance / 4, depth - 1) +
         integrate(f, mx, my, x1, y1, tolerance / 4, depth - 1);
}

}  // namespace detail

/// `sample(Random&)` returns std::optional<Vec3>, a unit direction; `pdf(Vec3)` its density in 1/sr. Draws without
/// result form a cell of their own, which is expected to hold what the density lacks to one.
template <class Sample, class Pdf>
ChiSquareResult test_directions(const Sample& sample, const Pdf& pdf, int sample_count, std::uint32_t seed = 1,
                                SphereGrid grid = {}) {
  const int cells = grid.rows * grid.columns;
  std::vector<double> observed(cells + 1), expected(cells + 1);
  Random random(seed);
  for (int i = 0; i < sample_count; ++i) {
    const std::optional<Vec3> direction = sample(random);
    ++observed[direction ? grid.cell_of(*direction) : cells];
  }
  double total = 0;
  for (int cell = 0; cell < cells; ++cell) {
    const double row = cell / grid.columns, column = cell % grid.columns;
    const auto density = [&](double x, double y) { return static_cast<double>(pdf(grid.direction(y, x))); };
    const double hundredth_of_a_sample = 0.01 / (grid.cell_solid_angle() * sample_count);
    const double mass = grid.cell_solid_angle() *
                        detail::integrate(density, column, row, column + 1, row + 1, hundredth_of_a_sample, 7);
    expected[cell] = mass * sample_count;
    total += mass;
  }
  // Densities are computed in float and integrated numerically: a defect below 1e-4 is no statement about failures.
  const double lacking = 1 - total;
  if (lacking < -1e-3) return {infinity, 1, 0};
  expected[cells] = lacking > 1e-4 ? lacking * sample_count : observed[cells];
  if (lacking <= 1e-4 && observed[cells] > 1e-3 * sample_count) return {infinity, 1, 0};
  return chi_square_test(observed, expected);
}

}  // namespace candil::test
