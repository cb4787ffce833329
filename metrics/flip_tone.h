/// The tone curve of FLIP for images of high dynamic range.
#pragma once

#include <array>

#include "metrics/fast_math.h"

namespace candil {

/// Narkowicz's fit of the ACES curve (2016), with the 0.6 of exposure that makes it comparable to others:
/// (a x^2 + b x) / (c x^2 + d x + e) for the coefficients a to e.
inline constexpr std::array<double, 5> aces = {0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14};

/// The curve at x >= 0 is above / below, cut to 1; x at most 1e15.
struct AcesFraction {
  float above, below;
};
[[gnu::always_inline]] inline AcesFraction aces_fraction(float x) {
  constexpr float a = static_cast<float>(aces[0]), b = static_cast<float>(aces[1]), c = static_cast<float>(aces[2]);
  constexpr float d = static_cast<float>(aces[3]), e = static_cast<float>(aces[4]);
  return {x * multiply_add(a, x, b), multiply_add(x, multiply_add(c, x, d), e)};
}

}  // namespace candil
