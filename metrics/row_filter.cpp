#include "metrics/row_filter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace candil {
namespace {

/// Columns that are summed up together, in registers.
constexpr int block = 32;
constexpr int lanes = 8;
constexpr int vectors = block / lanes;
using Lanes = float __attribute__((vector_size(lanes * sizeof(float))));

/// `before(k)` and `after(k)` point at the values of output 0 that are k to either side of it. Every output is summed
/// in the same order, wherever it lies in a block.
template <bool is_symmetric, typename Before, typename After>
void filter_block(const float* weights, int radius, const Before& before, const After& after, float* out, int x) {
  Lanes sums[vectors];
  for (int v = 0; v < vectors; ++v) {
    Lanes middle;
    std::memcpy(&middle, after(0) + x + v * lanes, sizeof middle);
    sums[v] = is_symmetric ? middle * weights[0] : middle * 0.0f;
  }
  for (int k = 1; k <= radius; ++k) {
    const float* const left = before(k) + x;
    const float* const right = after(k) + x;
    for (int v = 0; v < vectors; ++v) {
      Lanes l, r;
      std::memcpy(&l, left + v * lanes, sizeof l);
      std::memcpy(&r, right + v * lanes, sizeof r);
      sums[v] += (is_symmetric ? r + l : r - l) * weights[k];
    }
  }
  std::memcpy(out + x, sums, sizeof sums);
}

template <bool is_symmetric, typename Before, typename After>
void filter(const float* weights, int radius, const Before& before, const After& after, float* out, int count) {
  if (count >= block) {
    for (int x = 0; x + block <= count; x += block) filter_block<is_symmetric>(weights, radius, before, after, out, x);
    // What is left, together with some that are done: cheaper than one by one.
    if (count % block != 0) filter_block<is_symmetric>(weights, radius, before, after, out, count - block);
    return;
  }
  for (int x = 0; x < count; ++x) {
    float sum = is_symmetric ? after(0)[x] * weights[0] : after(0)[x] * 0.0f;
    for (int k = 1; k <= radius; ++k)
      sum += (is_symmetric ? after(k)[x] + before(k)[x] : after(k)[x] - before(k)[x]) * weights[k];
    out[x] = sum;
  }
}

template <typename Before, typename After>
void filter(const HalfKernel& kernel, const Before& before, const After& after, float* out, int count) {
  const float* const weights = kernel.weights.data();
  if (kernel.is_symmetric)
    filter<true>(weights, kernel.radius(), before, after, out, count);
  else
    filter<false>(weights, kernel.radius(), before, after, out, count);
}

}  // namespace

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

void filter_along_row(const HalfKernel& kernel, const float* in, float* out, int count) {
  filter(
      kernel, [in](int k) { return in - k; }, [in](int k) { return in + k; }, out, count);
}

void filter_across_rows(const HalfKernel& kernel, std::span<const float* const> rows, float* out, int count) {
  const auto middle = static_cast<int>(rows.size()) / 2;
  filter(
      kernel, [&](int k) { return rows[static_cast<std::size_t>(middle - k)]; },
      [&](int k) { return rows[static_cast<std::size_t>(middle + k)]; }, out, count);
}

}  // namespace candil
