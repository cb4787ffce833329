/// Pixel reconstruction by importance sampling: the filter decides where in and around its pixel a sample falls, so
/// that each sample touches one pixel only (Ernst, Stamminger and Greiner 2006, "Filter importance sampling").
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/math.h"

namespace candil {

enum class FilterKind { box, blackman_harris, gaussian };

/// "box", "blackman-harris", "gaussian"; nothing for any other name.
std::optional<FilterKind> filter_from_name(std::string_view name);

class PixelFilter {
 public:
  explicit PixelFilter(FilterKind kind);
  /// Offset from the pixel's centre in pixels, distributed like the filter. Box: [-0.5, 0.5); Blackman-Harris: within
  /// 1.5 (a window 3 pixels wide); Gaussian: standard deviation 0.5, cut at 1.5. u in [0, 1)^2.
  Vec2 sample(Vec2 u) const;

 private:
  static constexpr int table_size = 256;
  float sample_1d(float u) const;
  std::array<float, table_size + 1> inverse_cdf_;
};

}  // namespace candil
