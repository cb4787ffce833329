#include "metrics/row_filter.h"

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "metrics/fast_math.h"

namespace candil {
namespace {

constexpr int lanes = 8;
using Lanes = float __attribute__((vector_size(lanes * sizeof(float))));

Lanes load(const float* values) {
  Lanes loaded;
  std::memcpy(&loaded, values, sizeof loaded);
  return loaded;
}

/// The compilers turn products and sums into one instruction only where they are told to, and not for all vectors.
Lanes multiply_add(Lanes a, float b, Lanes c) {
#if defined(__FMA__)
  return _mm256_fmadd_ps(a, _mm256_set1_ps(b), c);
#else
  Lanes sum;
  for (int i = 0; i < lanes; ++i) sum[i] = candil::multiply_add(a[i], b, c[i]);
  return sum;
#endif
}

/// Weights of kernels with the same radius, and what becomes of them.
template <std::size_t kernels>
struct Filters {
  std::array<const float*, kernels> weights;
  std::array<float*, kernels> out;
  int radius;
};

/// `before(k)` and `after(k)` point at the values of output 0 that are k to either side of it. Every output is summed
/// in the same order, wherever it lies in a block.
template <int vectors, bool... is_symmetric, typename Before, typename After>
void filter_block(const Filters<sizeof...(is_symmetric)>& filters, const Before& before, const After& after, int x) {
  constexpr std::size_t kernels = sizeof...(is_symmetric);
  constexpr std::array symmetric = {is_symmetric...};
  Lanes sums[vectors][kernels];
  for (int v = 0; v < vectors; ++v)
    for (std::size_t i = 0; i < kernels; ++i)
      sums[v][i] = symmetric[i] ? load(after(0) + x + v * lanes) * filters.weights[i][0] : Lanes{};
  for (int k = 1; k <= filters.radius; ++k) {
    const float* const left = before(k) + x;
    const float* const right = after(k) + x;
    for (int v = 0; v < vectors; ++v) {
      const Lanes l = load(left + v * lanes), r = load(right + v * lanes);
      for (std::size_t i = 0; i < kernels; ++i)
        sums[v][i] = multiply_add(symmetric[i] ? r + l : r - l, filters.weights[i][k], sums[v][i]);
    }
  }
#pragma GCC unroll 4  // else the sums leave their registers twice
  for (int v = 0; v < vectors; ++v)
#pragma GCC unroll 3
    for (std::size_t i = 0; i < kernels; ++i) {
      const Lanes sum = sums[v][i];
      std::memcpy(filters.out[i] + x + v * lanes, &sum, sizeof sum);
    }
}

template <bool... is_symmetric, typename Before, typename After>
void filter(const Filters<sizeof...(is_symmetric)>& filters, const Before& before, const After& after, int count) {
  // As many columns at a time as there are registers for their sums.
  constexpr std::size_t kernels = sizeof...(is_symmetric);
  constexpr int vectors = kernels > 2 ? 2 : 4, block = vectors * lanes;
  if (count >= block) {
    for (int x = 0; x + block <= count; x += block) filter_block<vectors, is_symmetric...>(filters, before, after, x);
    // What is left, together with some that are done: cheaper than one by one.
    if (count % block != 0) filter_block<vectors, is_symmetric...>(filters, before, after, count - block);
    return;
  }
  constexpr std::array symmetric = {is_symmetric...};
  for (int x = 0; x < count; ++x)
    for (std::size_t i = 0; i < kernels; ++i) {
      const float* const weights = filters.weights[i];
      float sum = symmetric[i] ? after(0)[x] * weights[0] : 0.0f;
      for (int k = 1; k <= filters.radius; ++k) {
        const float both = symmetric[i] ? after(k)[x] + before(k)[x] : after(k)[x] - before(k)[x];
        sum = candil::multiply_add(both, weights[k], sum);
      }
      filters.out[i][x] = sum;
    }
}

template <typename Before, typename After>
void filter_one(const FilterTask& task, const Before& before, const After& after, int count) {
  const Filters<1> filters = {{task.kernel.weights.data()}, {task.out}, task.kernel.radius()};
  task.kernel.is_symmetric ? filter<true>(filters, before, after, count) : filter<false>(filters, before, after, count);
}

/// The sets of kernels that FLIP has go through the input together.
template <typename Before, typename After>
void filter(std::span<const FilterTask> tasks, const Before& before, const After& after, int count) {
  const auto fits = [&](std::initializer_list<bool> symmetric) {
    return std::ranges::equal(tasks, symmetric, [&](const FilterTask& task, bool is_symmetric) {
      return task.kernel.is_symmetric == is_symmetric && task.kernel.radius() == tasks[0].kernel.radius();
    });
  };
  const auto weights = [&](std::size_t i) { return tasks[i].kernel.weights.data(); };
  const auto pair = [&] {
    return Filters<2>{{weights(0), weights(1)}, {tasks[0].out, tasks[1].out}, tasks[0].kernel.radius()};
  };
  if (fits({true, true}))
    filter<true, true>(pair(), before, after, count);
  else if (fits({false, true}))
    filter<false, true>(pair(), before, after, count);
  else if (fits({true, false, true}))
    filter<true, false, true>(
        {{weights(0), weights(1), weights(2)}, {tasks[0].out, tasks[1].out, tasks[2].out}, tasks[0].kernel.radius()},
        before, after, count);
  else
    for (const FilterTask& task : tasks) filter_one(task, before, after, count);
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

void filter_along_row(std::span<const FilterTask> tasks, const float* in, int count) {
  filter(
      tasks, [in](int k) { return in - k; }, [in](int k) { return in + k; }, count);
}

void filter_across_rows(std::span<const FilterTask> tasks, std::span<const float* const> rows, int count) {
  const auto middle = static_cast<int>(rows.size()) / 2;
  filter(
      tasks, [&](int k) { return rows[static_cast<std::size_t>(middle - k)]; },
      [&](int k) { return rows[static_cast<std::size_t>(middle + k)]; }, count);
}

void filter_along_row(const HalfKernel& kernel, const float* in, float* out, int count) {
  const FilterTask task = {kernel, out};
  filter_along_row({&task, 1}, in, count);
}

void filter_across_rows(const HalfKernel& kernel, std::span<const float* const> rows, float* out, int count) {
  const FilterTask task = {kernel, out};
  filter_across_rows({&task, 1}, rows, count);
}

}  // namespace candil
