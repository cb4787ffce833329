/// One-dimensional filters over floats, several kernels at a time, as vector code of the processor that the including
/// file is compiled for (core/bvh/target.h). Plain sums of products: the same bits on all of them.
#pragma once

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include <cstddef>
#include <cstring>
#include <utility>

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

/// The halves of kernels (HalfKernel), of the same radius or the largest first, and where their results go. With
/// `adds`, onto what is there.
template <std::size_t kernels>
struct Filters {
  const float* weights[kernels];
  float* out[kernels];
  int radii[kernels];
  bool adds = false;
};

/// The sums of a block of columns under way, one after the other of the places k to either side of them.
template <int vectors, bool... is_symmetric>
struct FilterSums {
  static constexpr std::size_t kernels = sizeof...(is_symmetric);
  static constexpr bool symmetric[] = {is_symmetric...};
  FilterLanes lanes[vectors][kernels];

  /// The middle, for output x.
  [[gnu::always_inline]] void start(const Filters<kernels>& filters, const float* middle, int x) {
#pragma GCC unroll 4
    for (int v = 0; v < vectors; ++v)
#pragma GCC unroll 4
      for (std::size_t i = 0; i < kernels; ++i) {
        const int place = x + v * filter_lanes;
        lanes[v][i] = filters.adds ? load_lanes(filters.out[i] + place) : FilterLanes{};
        if (symmetric[i])
          lanes[v][i] = multiply_add_lanes(load_lanes(middle + place), filters.weights[i][0], lanes[v][i]);
      }
  }

  /// What is k places beside, of the first `active` kernels.
  template <std::size_t active>
  [[gnu::always_inline]] void add(const Filters<kernels>& filters, const float* left, const float* right, int k) {
#pragma GCC unroll 4
    for (int v = 0; v < vectors; ++v) {
      const FilterLanes l = load_lanes(left + v * filter_lanes), r = load_lanes(right + v * filter_lanes);
#pragma GCC unroll 4
      for (std::size_t i = 0; i < active; ++i)
        lanes[v][i] = multiply_add_lanes(symmetric[i] ? r + l : r - l, filters.weights[i][k], lanes[v][i]);
    }
  }

  /// All places from k on: those that all kernels reach, then those that all but the last reach, and so on.
  template <std::size_t active, typename Before, typename After>
  [[gnu::always_inline]] void add_all(const Filters<kernels>& filters, const Before& before, const After& after, int x,
                                      int k) {
    for (; k <= filters.radii[active - 1]; ++k) add<active>(filters, before(k) + x, after(k) + x, k);
    if constexpr (active > 1) add_all<active - 1>(filters, before, after, x, k);
  }
};

/// `before(k)` and `after(k)` point at the values of output 0 that are k to either side of it. Every output is summed
/// in the same order, wherever it lies in a block.
template <int vectors, bool... is_symmetric, typename Before, typename After>
[[gnu::always_inline]] inline void filter_block(const Filters<sizeof...(is_symmetric)>& filters, const Before& before,
                                                const After& after, int x) {
  constexpr std::size_t kernels = sizeof...(is_symmetric);
  FilterSums<vectors, is_symmetric...> sums;
  sums.start(filters, after(0), x);
  sums.template add_all<kernels>(filters, before, after, x, 1);
#pragma GCC unroll 4  // else the sums leave their registers twice
  for (int v = 0; v < vectors; ++v)
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kernels; ++i) {
      const FilterLanes sum = sums.lanes[v][i];
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
      for (int k = 1; k <= filters.radii[i]; ++k) {
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

/// Sums across `batch` rows below each other, of some columns and kernels. Rows are taken from the top to the bottom,
/// and each adds to all outputs that it reaches, so that it is loaded once for all of them.
template <int batch, int vectors, std::size_t kernels>
struct BatchSums {
  FilterLanes lanes[kernels][batch][vectors] = {};

  /// Adds what whole kernels (2 radius + 1 weights each) make of the rows; rows[0] is the uppermost that output 0 sees.
  /// The radius is at least 1.
  [[gnu::always_inline]] void add(const float* const (&weights)[kernels], int radius, const float* const* rows, int x) {
    // Those at the top reach the first outputs only, those at the bottom the last ones.
    add_top(weights, rows, x, std::make_integer_sequence<int, batch - 1>());
    for (int j = batch - 1; j <= 2 * radius; ++j) add_row<0, batch>(weights, rows, j, x);
    add_bottom(weights, 2 * radius, rows, x, std::make_integer_sequence<int, batch - 1>());
  }

  /// Writes them to rows that are `stride` apart.
  [[gnu::always_inline]] void store(std::size_t kernel, float* out, std::size_t stride, int x) const {
#pragma GCC unroll 8
    for (int r = 0; r < batch; ++r)
#pragma GCC unroll 4
      for (int v = 0; v < vectors; ++v)
        std::memcpy(out + static_cast<std::size_t>(r) * stride + x + v * filter_lanes, &lanes[kernel][r][v],
                    sizeof(FilterLanes));
  }

 private:
  template <int first, int end>
  [[gnu::always_inline]] void add_row(const float* const (&weights)[kernels], const float* const* rows, int j, int x) {
    FilterLanes values[vectors];
#pragma GCC unroll 4
    for (int v = 0; v < vectors; ++v) values[v] = load_lanes(rows[j] + x + v * filter_lanes);
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kernels; ++i)
#pragma GCC unroll 8
      for (int r = first; r < end; ++r)
#pragma GCC unroll 4
        for (int v = 0; v < vectors; ++v)
          lanes[i][r][v] = multiply_add_lanes(values[v], weights[i][j - r], lanes[i][r][v]);
  }

  template <int... j>
  [[gnu::always_inline]] void add_top(const float* const (&weights)[kernels], const float* const* rows, int x,
                                      std::integer_sequence<int, j...>) {
    (add_row<0, j + 1>(weights, rows, j, x), ...);
  }
  template <int... j>
  [[gnu::always_inline]] void add_bottom(const float* const (&weights)[kernels], int last, const float* const* rows,
                                         int x, std::integer_sequence<int, j...>) {
    (add_row<j + 1, batch>(weights, rows, last + 1 + j, x), ...);
  }
};

}  // namespace CANDIL_TARGET
}  // namespace candil
