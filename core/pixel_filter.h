/// Pixel reconstruction by importance sampling: the filter decides where in and around its pixel a sample falls, so
/// that each sample touches one pixel only (Ernst, Stamminger and Greiner 2006, "Filter importance sampling").
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/simd.h"

namespace candil {

enum class FilterKind { box, blackman_harris, gaussian };

/// "box", "blackman-harris", "gaussian"; nothing for any other name.
std::optional<FilterKind> filter_from_name(std::string_view name);

class PixelFilter {
 public:
  explicit PixelFilter(FilterKind kind);
  /// Offset from the pixel's centre in pixels, distributed like the filter. Box: [-0.5, 0.5); Blackman-Harris: within
  /// 1.5 (a window 3 pixels wide); Gaussian: standard deviation 0.5, cut at 1.5. u in [0, 1)^2.
  Vec2 sample(Vec2 u) const { return {sample_1d(u.x), sample_1d(u.y)}; }
  /// sample() along one axis, of one number or of eight.
  float sample_1d(float u) const {
    const float position = u * table_size;
    const int index = glm::min(static_cast<int>(position), table_size - 1);
    return glm::mix(inverse_cdf_[index], inverse_cdf_[index + 1], position - static_cast<float>(index));
  }
  FloatLanes sample_1d(FloatLanes u) const {
    const FloatLanes position = u * static_cast<float>(table_size);
    FloatLanes low{}, high{}, start{};
    for (int i = 0; i < 8; ++i) {
      const int index = glm::min(static_cast<int>(position[i]), table_size - 1);
      low[i] = inverse_cdf_[index], high[i] = inverse_cdf_[index + 1], start[i] = static_cast<float>(index);
    }
    const FloatLanes part = position - start;
    return low * (1 - part) + high * part;
  }

 private:
  static constexpr int table_size = 256;
  std::array<float, table_size + 1> inverse_cdf_;
};

}  // namespace candil
