/// One-dimensional filters over floats, several kernels at a time, as vector code of the processor that the including
/// file is compiled for (core/bvh/target.h). Plain sums of products: the same bits on all of them.
#pragma once

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstring>

#include "core/bvh/target.h"
#include "metrics/fast_math.h"

namespace candil {
inline namespace CANDIL_TARGET {

#if defined(__AVX512F__)
inline constexpr int filter_lanes = 16;
#else
inline constexpr int filter_lanes = 8;
#endif
using FilterLanes = float __attribute__((vector_size(filter_lanes * sizeof(float))));

[[gnu::always_inline]] inline FilterLanes load_lanes(const float* values) {
  FilterLanes loaded;
  std::memcpy(&loaded, values, sizeof loaded);
  return loaded;
}

/// The compilers turn products and sums into one instruction only where they are told to, and not for all vectors.
[[gnu::always_inline]] inline FilterLanes multiply_add_lanes(FilterLanes a, float b, FilterLanes c) {
#if defined(__AVX512F__)
  return _mm512_fmadd_ps(a, _mm512_set1_ps(b), c);
#elif defined(__FMA__)
  return _mm256_fmadd_ps(a, _mm256_set1_ps(b), c);
#else
  FilterLanes sum;
  for (int i = 0; i < filter_lanes; ++i) sum[i] = multiply_add(a[i], b, c[i]);
  return sum;
#endif
}

/// The halves of kernels of the same radius (HalfKernel), and where their results go. With `adds`, onto what is there.
template <std::size_t kernels>
struct Filters {
  const float* weights[kernels];
  float* out[kernels];
  int radius;
  bool adds = false;
};

/// `before(k)` and `after(k)` point at the values of output 0 that are k to either side of it. Every output is summed
/// in the same order, wherever it lies in a block.
template <int vectors, bool... is_symmetric, typename Before, typename After>
[[gnu::always_inline]] inline void filter_block(const Filters<sizeof...(is_symmetric)>& filters, const Before& before,
                                                const After& after, int x) {
  constexpr std::size_t kernels = sizeof...(is_symmetric);
  constexpr bool symmetric[] = {is_symmetric...};
  FilterLanes sums[vectors][kernels];
#pragma GCC unroll 4
  for (int v = 0; v < vectors; ++v)
#pragma GCC unroll 3
    for (std::size_t i = 0; i < kernels; ++i) {
      const int place = x + v * filter_lanes;
      sums[v][i] = filters.adds ? load_lanes(filters.out[i] + place) : FilterLanes{};
      if (symmetric[i])
        sums[v][i] = multiply_add_lanes(load_lanes(after(0) + place), filters.weights[i][0], sums[v][i]);
    }
  for (int k = 1; k <= filters.radius; ++k) {
    const float* const left = before(k) + x;
    const float* const right = after(k) + x;
#pragma GCC unroll 4
    for (int v = 0; v < vectors; ++v) {
      const FilterLanes l = load_lanes(left + v * filter_lanes), r = load_lanes(right + v * filter_lanes);
#pragma GCC unroll 3
      for (std::size_t i = 0; i < kernels; ++i)
        sums[v][i] = multiply_add_lanes(symmetric[i] ? r + l : r - l, filters.weights[i][k], sums[v][i]);
    }
  }
#pragma GCC unroll 4  // else the sums leave their registers twice
  for (int v = 0; v < vectors; ++v)
#pragma GCC unroll 3
    for (std::size_t i = 0; i < kernels; ++i) {
      const FilterLanes sum = sums[v][i];
      std::memcpy(filters.out[i] + x + v * filter_lanes, &sum, sizeof sum);
    }
}

/// All outputs below `count`.
template <bool... is_symmetric, typename Before, typename After>
void filter_values(const Filters<sizeof...(is_symmetric)>& filters, const Before& before, const After& after,
                   int count) {
  // As many columns at a time as there are registers for their sums.
  constexpr std::size_t kernels = sizeof...(is_symmetric);
  constexpr int vectors = kernels > 2 && filter_lanes < 16 ? 2 : 4, block = vectors * filter_lanes;
  int x = 0;
  for (; x + block <= count; x += block) filter_block<vectors, is_symmetric...>(filters, before, after, x);
  for (; x + filter_lanes <= count; x += filter_lanes) filter_block<1, is_symmetric...>(filters, before, after, x);
  constexpr bool symmetric[] = {is_symmetric...};
  for (; x < count; ++x)
    for (std::size_t i = 0; i < kernels; ++i) {
      const float* const weights = filters.weights[i];
      float sum = filters.adds ? filters.out[i][x] : 0.0f;
      if (symmetric[i]) sum = multiply_add(after(0)[x], weights[0], sum);
      for (int k = 1; k <= filters.radius; ++k) {
        const float both = symmetric[i] ? after(k)[x] + before(k)[x] : after(k)[x] - before(k)[x];
        sum = multiply_add(both, weights[k], sum);
      }
      filters.out[i][x] = sum;
    }
}

/// Along a row: `in` has radius more on either side and points at the value of output 0.
template <bool... is_symmetric>
void filter_along(const Filters<sizeof...(is_symmetric)>& filters, const float* in, int count) {
  filter_values<is_symmetric...>(
      filters, [in](int k) { return in - k; }, [in](int k) { return in + k; }, count);
}

/// Across rows: `middle` points at the row of the output among those above and below.
template <bool... is_symmetric>
void filter_across(const Filters<sizeof...(is_symmetric)>& filters, const float* const* middle, int count) {
  filter_values<is_symmetric...>(
      filters, [middle](int k) { return middle[-k]; }, [middle](int k) { return middle[k]; }, count);
}

/// Across `batch` rows below each other, the first of which is `middle`; their outputs are `stride` apart. Some columns
/// at a time, while what the rows share is near.
template <int batch, bool... is_symmetric>
void filter_batch(const Filters<sizeof...(is_symmetric)>& filters, const float* const* middle, std::size_t stride,
                  int count) {
  constexpr int block = 4 * filter_lanes;
  for (int x = 0; x < count; x += block)
    for (int r = 0; r < batch; ++r) {
      Filters<sizeof...(is_symmetric)> part = filters;
      for (float*& out : part.out) out += static_cast<std::size_t>(r) * stride + static_cast<std::size_t>(x);
      const float* const* const rows = middle + r;
      filter_values<is_symmetric...>(
          part, [rows, x](int k) { return rows[-k] + x; }, [rows, x](int k) { return rows[k] + x; },
          count - x < block ? count - x : block);
    }
}

}  // namespace CANDIL_TARGET
}  // namespace candil
