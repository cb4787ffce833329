/// Rows of pixels in the form that vector code wants. What is always inline is for files for newer processors too
/// (core/bvh/target.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace candil {

/// The first three channels of a row of pixels that have 3 or 4, one array for each.
template <int channels>
[[gnu::always_inline]] inline void split_channels(const float* pixels, int count, const std::array<float*, 3>& out) {
  float* const __restrict red = out[0];
  float* const __restrict green = out[1];
  float* const __restrict blue = out[2];
  for (int i = 0; i < count; ++i) {
    red[i] = pixels[i * channels];
    green[i] = pixels[i * channels + 1];
    blue[i] = pixels[i * channels + 2];
  }
}

[[gnu::always_inline]] inline void split_colors(const float* pixels, int channels, int count,
                                                const std::array<float*, 3>& out) {
  channels == 4 ? split_channels<4>(pixels, count, out) : split_channels<3>(pixels, count, out);
}

/// Quickly: neither infinite nor NaN, any of them.
inline bool is_finite_row(const float* values, std::size_t count) {
  std::uint32_t largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    largest = std::max(largest, std::bit_cast<std::uint32_t>(values[i]) & 0x7fffffffu);
  return largest < 0x7f800000u;
}

}  // namespace candil
