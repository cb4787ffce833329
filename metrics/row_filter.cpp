#include "metrics/row_filter.h"

#include <cmath>
#include <cstdlib>

#include "metrics/filter_block.h"

namespace candil {

HalfKernel gaussian_kernel(double sigma, int radius) {
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k <= radius; ++k) {
    weights.push_back(std::exp(-k * k / (2 * sigma * sigma)));
    sum += k == 0 ? weights.back() : 2 * weights.back();
  }
  HalfKernel kernel;
  for (const double weight : weights) kernel.weights.push_back(static_cast<float>(weight / sum));
  return kernel;
}

std::vector<float> whole_kernel(const HalfKernel& kernel) {
  std::vector<float> whole;
  for (int k = -kernel.radius(); k <= kernel.radius(); ++k) {
    const float weight = kernel.weights[static_cast<std::size_t>(std::abs(k))];
    if (kernel.is_symmetric)
      whole.push_back(weight);
    else
      whole.push_back(k > 0 ? weight : (k < 0 ? -weight : 0.0f));
  }
  return whole;
}

void filter_along_row(const HalfKernel& kernel, const float* in, float* out, int count) {
  const Filters<1> filters = {{kernel.weights.data()}, {out}, {kernel.radius()}};
  kernel.is_symmetric ? filter_along<true>(filters, in, count) : filter_along<false>(filters, in, count);
}

void filter_across_rows(const HalfKernel& kernel, std::span<const float* const> rows, float* out, int count) {
  const Filters<1> filters = {{kernel.weights.data()}, {out}, {kernel.radius()}};
  const float* const* const middle = rows.data() + rows.size() / 2;
  kernel.is_symmetric ? filter_across<true>(filters, middle, count) : filter_across<false>(filters, middle, count);
}

}  // namespace candil
