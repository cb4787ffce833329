#include "metrics/z_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "metrics/parallel_rows.h"
#include "metrics/student_t.h"
#include "metrics/z_test_levels.h"

namespace candil {
namespace {

constexpr int channels = 3;
/// Squares of 2^6 pixels are done on one core each, larger ones from their sums.
constexpr int tile_level = 6;

/// What adds up over the pixels of a square, for one channel.
struct Sums {
  double pixels = 0;
  double a = 0, difference = 0;
  double variance = 0;         // of the difference
  double variance_spread = 0;  // sum of variance^2 over its degrees of freedom: Satterthwaite's denominator
  double squares = 0;          // of the difference
  double rounding = 0;         // largest difference that rounding explains
  double certain_changes = 0;  // pixels with values that are not finite on one side

  Sums& operator+=(const Sums& other) {
    pixels += other.pixels, a += other.a, difference += other.difference, variance += other.variance;
    variance_spread += other.variance_spread, squares += other.squares, rounding += other.rounding;
    certain_changes += other.certain_changes;
    return *this;
  }
};
using ColorSums = std::array<Sums, channels>;

double valid_variance(float variance) { return variance > 0 && variance < infinity ? variance : 0; }

class Tester {
 public:
  Tester(const ImagePair& pair, const ImageVariance& a, const ImageVariance& b, const PixelSelection& selection,
         const ZTestSettings& settings)
      : pair_(pair), a_(a), b_(b), selection_(selection), settings_(settings) {
    if (a.samples == 0 || b.samples == 0) return;
    const double n = a.samples, m = b.samples;
    // One over the number of ways to choose n of n + m samples.
    log10_deal_ = (std::lgamma(n + 1) + std::lgamma(m + 1) - std::lgamma(n + m + 1)) / std::log(10.0);
  }

  /// Tests a square and everything in it, and returns its sums.
  ColorSums test_square(int x, int y, int level, LevelTests& tests) const {
    ColorSums sums = level == 0 ? measure_pixel(x, y) : ColorSums{};
    if (level > 0) {
      const int half = 1 << (level - 1);
      for (const int dy : {0, half})
        for (const int dx : {0, half})
          if (x + dx < pair_.width() && y + dy < pair_.height())
            add(sums, test_square(x + dx, y + dy, level - 1, tests));
    }
    judge(sums, x, y, level, tests);
    return sums;
  }

  static void add(ColorSums& sums, const ColorSums& more) {
    for (std::size_t c = 0; c < channels; ++c) sums[c] += more[c];
  }

  void judge(const ColorSums& sums, int x, int y, int level, LevelTests& tests) const {
    for (int c = 0; c < channels; ++c) {
      const Sums& sum = sums[static_cast<std::size_t>(c)];
      if (sum.pixels == 0) continue;
      tests.count(level);
      const double spread = level == 0 ? sum.variance : std::max(sum.variance, sum.squares);
      const double variance = spread + sum.rounding * sum.rounding;
      // No distribution gives less than the 0.001 below this many standard errors, and nothing else is looked at.
      constexpr double unremarkable = 3.29;
      const bool is_certain = sum.certain_changes > 0;
      if (!is_certain && !(sum.difference * sum.difference > unremarkable * unremarkable * variance)) continue;
      const double deviation = variance > 0 ? sum.difference / std::sqrt(variance) : std::copysign(1e9, sum.difference);
      tests.add(level, is_certain ? least_log10_p : log10_p(sum, level, variance, deviation), [&] {
        return ZTest::Place{{x, y, std::min(1 << level, pair_.width() - x), std::min(1 << level, pair_.height() - y)},
                            c,
                            deviation,
                            sum.a / sum.pixels,
                            sum.difference / sum.pixels};
      });
    }
  }

 private:
  double log10_p(const Sums& sum, int level, double variance, double deviation) const {
    const bool is_exact = sum.variance_spread == 0 || a_.samples == 0 || b_.samples == 0;
    const double freedom = is_exact ? infinity : variance * variance / sum.variance_spread;
    const double log10_tails = log10_student_tails(std::abs(deviation), freedom);
    constexpr double log10_2 = 0.30103;  // two-sided
    const double hoeffding = log10_2 - deviation * deviation / 2 * std::numbers::log10e;
    return std::max({log10_tails, level == 0 ? log10_2 + log10_deal_ : hoeffding, least_log10_p});
  }

  ColorSums measure_pixel(int x, int y) const {
    ColorSums sums;
    if (!selection_.contains(x, y)) return sums;
    for (int c = 0; c < channels; ++c) {
      Sums& sum = sums[static_cast<std::size_t>(c)];
      const float a = pair_.a.pixel(x, y)[c], b = pair_.b.pixel(x, y)[c];
      sum.pixels = 1;
      const float d = difference(a, b);
      if (!std::isfinite(d)) {
        sum.certain_changes = 1;
        continue;
      }
      if (!std::isfinite(a)) continue;
      sum.a = a, sum.difference = d, sum.squares = static_cast<double>(d) * d;
      sum.rounding = settings_.rounding * std::max(std::abs(a), std::abs(b));
      add_variance(valid_variance(a_.variance.pixel(x, y)[c]), valid_variance(b_.variance.pixel(x, y)[c]), sum);
    }
    return sums;
  }

  void add_variance(double a, double b, Sums& sum) const {
    sum.variance = a + b;
    if (a_.samples < 2 || b_.samples < 2) return;
    const double n = a_.samples, m = b_.samples;
    sum.variance_spread = a * a / (n - 1) + b * b / (m - 1);
    const double of_sample = ((n - 1) * n * a + (m - 1) * m * b) / (n + m - 2);
    const double pooled = of_sample * (1 / n + 1 / m);
    if (pooled <= sum.variance) return;
    sum.variance = pooled;
    sum.variance_spread = pooled * pooled / (n + m - 2);
  }

  const ImagePair& pair_;
  const ImageVariance &a_, &b_;
  const PixelSelection& selection_;
  ZTestSettings settings_;
  double log10_deal_ = -1000;
};

/// The squares of each size, of which those of the last one cover the image.
int count_levels(const ImagePair& pair) {
  int levels = 1;
  while (1 << (levels - 1) < std::max(pair.width(), pair.height())) ++levels;
  return levels;
}

/// Sums of squares, row by row.
struct Grid {
  int width = 0, height = 0;
  std::vector<ColorSums> squares;
};

/// Four squares each make one of the next size; all are tested.
Grid test_larger(const Grid& grid, int level, const Tester& tester, LevelTests& tests) {
  Grid larger{(grid.width + 1) / 2, (grid.height + 1) / 2, {}};
  larger.squares.resize(static_cast<std::size_t>(larger.width) * larger.height);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      Tester::add(larger.squares[static_cast<std::size_t>(y / 2) * larger.width + x / 2],
                  grid.squares[static_cast<std::size_t>(y) * grid.width + x]);
  for (int y = 0; y < larger.height; ++y)
    for (int x = 0; x < larger.width; ++x)
      tester.judge(larger.squares[static_cast<std::size_t>(y) * larger.width + x], x << level, y << level, level,
                   tests);
  return larger;
}

}  // namespace

ZTest measure_z_test(const ImagePair& pair, const ImageVariance& a, const ImageVariance& b,
                     const PixelSelection& selection, const ZTestSettings& settings) {
  const Tester tester(pair, a, b, selection, settings);
  const int levels = count_levels(pair), first_level = std::min(tile_level, levels - 1);
  const int side = 1 << first_level;
  Grid grid{(pair.width() + side - 1) / side, (pair.height() + side - 1) / side, {}};
  grid.squares.resize(static_cast<std::size_t>(grid.width) * grid.height);
  LevelTests tests(levels);
  // A row of tiles at a time, added up in the order of the rows.
  std::vector<std::optional<LevelTests>> rows(static_cast<std::size_t>(grid.height));
  for_each_part(grid.height, [&](int y) {
    LevelTests mine(levels);
    for (int x = 0; x < grid.width; ++x)
      grid.squares[static_cast<std::size_t>(y) * grid.width + x] =
          tester.test_square(x * side, y * side, first_level, mine);
    rows[static_cast<std::size_t>(y)] = std::move(mine);
  });
  for (std::optional<LevelTests>& row : rows) tests.merge(*row), row.reset();
  for (int level = first_level + 1; level < levels; ++level) grid = test_larger(grid, level, tester, tests);
  return tests.result();
}

}  // namespace candil
