/// The bookkeeping of many tests at once: p-values by size of square, corrected for their number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "metrics/z_test.h"

namespace candil {

/// Smallest logarithm of a p-value that is told apart.
inline constexpr double least_log10_p = -1000;

/// Only p-values below 0.001 are kept, as counts of bins 1/16 of a decade wide: p is never taken for smaller than it
/// is, and for 15 % larger at the most. Counting makes results independent of any order.
class LevelTests {
 public:
  explicit LevelTests(int levels);

  /// One more test of this level was made.
  void count(int level) { ++levels_[static_cast<std::size_t>(level)].tests; }
  /// It had this p-value; `place()` tells where, if it is worth knowing.
  template <typename MakePlace>
  void add(int level, double log10_p, const MakePlace& place) {
    if (!(log10_p < log10_kept)) return;
    Level& mine = levels_[static_cast<std::size_t>(level)];
    mine.add(log10_p);
    if (log10_p < mine.smallest) mine.smallest = log10_p, mine.place = place();
  }
  /// Adds the tests of squares that come after these.
  void merge(const LevelTests& later);

  ZTest result() const;

 private:
  static constexpr double log10_kept = -3;
  static constexpr int bins_per_decade = 16;

  struct Level {
    std::size_t tests = 0;
    std::vector<std::uint32_t> bins;  // by -log10 p - 3; as many as are needed
    double smallest = 0;              // log10 p
    ZTest::Place place;

    void add(double log10_p);
    /// log10 of the smallest p(k) tests / k over the k smallest p-values (Benjamini and Hochberg's adjusted p-value of
    /// the most significant test).
    double adjusted_log10_p() const;
    /// How many tests the procedure calls significant at this level.
    std::size_t count_significant(double log10_level) const;
  };

  std::vector<Level> levels_;
};

}  // namespace candil
