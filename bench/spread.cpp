#include "bench/spread.h"

#include <algorithm>
#include <cassert>

namespace candil {

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {values.front(), median, values.back()};
}

Spread spread_of_ratios(std::span<const double> a, std::span<const double> b) {
  assert(a.size() == b.size());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (b[i] != 0) ratios.push_back(a[i] / b[i]);
  }
  return spread_of(std::move(ratios));
}

}  // namespace candil
