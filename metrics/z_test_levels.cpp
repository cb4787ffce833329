#include "metrics/z_test_levels.h"

#include <algorithm>
#include <cmath>

namespace candil {

LevelTests::LevelTests(int levels) : levels_(static_cast<std::size_t>(levels)) {}

void LevelTests::Level::add(double log10_p) {
  // A bin is named by its largest p-value.
  const auto bin =
      static_cast<std::size_t>(std::floor((log10_kept - std::max(log10_p, least_log10_p)) * bins_per_decade));
  if (bin >= bins.size()) bins.resize(bin + 1);
  ++bins[bin];
}

double LevelTests::Level::adjusted_log10_p() const {
  double best = 0;
  std::size_t below = 0;
  for (std::size_t bin = bins.size(); bin-- > 0;) {
    below += bins[bin];
    if (bins[bin] == 0) continue;
    const double largest = log10_kept - static_cast<double>(bin) / bins_per_decade;
    best = std::min(best, largest + std::log10(static_cast<double>(tests) / static_cast<double>(below)));
  }
  return best;
}

std::size_t LevelTests::Level::count_significant(double log10_level) const {
  std::size_t below = 0, significant = 0;
  for (std::size_t bin = bins.size(); bin-- > 0;) {
    below += bins[bin];
    const double largest = log10_kept - static_cast<double>(bin) / bins_per_decade;
    const double allowed = log10_level + std::log10(static_cast<double>(below) / static_cast<double>(tests));
    if (bins[bin] > 0 && largest <= allowed) significant = below;
  }
  return significant;
}

void LevelTests::merge(const LevelTests& later) {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& mine = levels_[i];
    const Level& other = later.levels_[i];
    mine.tests += other.tests;
    if (other.bins.size() > mine.bins.size()) mine.bins.resize(other.bins.size());
    for (std::size_t bin = 0; bin < other.bins.size(); ++bin) mine.bins[bin] += other.bins[bin];
    if (other.smallest < mine.smallest) mine.smallest = other.smallest, mine.place = other.place;
  }
}

ZTest LevelTests::result() const {
  ZTest test;
  double best = 0;
  for (const Level& level : levels_) {
    const double adjusted = level.adjusted_log10_p();
    if (adjusted < best || (&level == &levels_.front())) best = std::min(best, adjusted), test.worst = level.place;
  }
  const double corrected = best + std::log10(static_cast<double>(levels_.size()));
  test.log10_p_value = std::clamp(corrected, least_log10_p, 0.0);
  test.p_value = std::pow(10, test.log10_p_value);
  test.pixel_tests = levels_.front().tests;
  test.significant_pixel_tests = levels_.front().count_significant(log10_kept);
  return test;
}

}  // namespace candil
