/// Numbers that were measured several times.
#pragma once

#include <span>
#include <vector>

namespace candil {

struct Spread {
  double min = 0, median = 0, max = 0;
};

/// Of an even number of values the median is the mean of the two in the middle. No values: all zero.
Spread spread_of(std::vector<double> values);

/// The spread of a[i] / b[i]: what was measured right after each other is compared, so that a machine that gets slower
/// meanwhile does not matter. As many of the one as of the other; pairs with b[i] = 0 are left out.
Spread spread_of_ratios(std::span<const double> a, std::span<const double> b);

}  // namespace candil
