/// Loops over the rows of an image on all cores, with results that do not depend on how the rows are shared out.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

namespace candil {

/// Calls `visit(i)` for every i below `count`, in any order.
template <typename Visit>
void for_each_part(int count, const Visit& visit) {
  tbb::parallel_for(0, count, visit);
}

/// Calls `visit(y)` for every row, in any order, some rows at a time.
template <typename Visit>
void for_each_row(int height, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 8), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) visit(y);
  });
}

/// The sum (+=) of what `measure(y)` gives for every row, added up from the first row to the last.
template <typename Result, typename Measure>
Result sum_rows(int height, const Measure& measure) {
  std::vector<Result> rows(static_cast<std::size_t>(height));
  for_each_row(height, [&](int y) { rows[static_cast<std::size_t>(y)] = measure(y); });
  Result total{};
  for (const Result& row : rows) total += row;
  return total;
}

}  // namespace candil
