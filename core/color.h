/// Colour: linear Rec.709 inside, sRGB at the edges.
#pragma once

#include <array>
#include <cmath>

#include "core/math.h"

namespace candil {

/// Luminance of linear Rec.709 (ITU-R BT.709-6).
inline float luminance(Vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// IEC 61966-2-1, exact piecewise form.
inline float srgb_to_linear(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }
inline float linear_to_srgb(float v) { return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f; }

namespace detail {
inline std::array<float, 256> make_byte_table(bool is_srgb) {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) {
    const float v = static_cast<float>(i) / 255;
    table[i] = is_srgb ? srgb_to_linear(v) : v;
  }
  return table;
}
}  // namespace detail

/// A byte as a linear value in [0, 1].
inline const std::array<float, 256> linear_of_srgb_byte = detail::make_byte_table(true);
inline const std::array<float, 256> linear_of_byte = detail::make_byte_table(false);

}  // namespace candil
