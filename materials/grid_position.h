/// Tables over coordinates in [0, 1], at evenly spaced points.
#pragma once

#include "core/math.h"

namespace candil {

/// The two grid points around a coordinate, and how far between them it is.
struct GridPosition {
  int index;
  float fraction;
  GridPosition(float coordinate, int count) {
    const float position = glm::clamp(coordinate, 0.0f, 1.0f) * static_cast<float>(count - 1);
    index = glm::min(static_cast<int>(position), count - 2);
    fraction = position - static_cast<float>(index);
  }
};

inline float grid_coordinate(int index, int count) { return static_cast<float>(index) / static_cast<float>(count - 1); }

/// Integral of 2 c dc times a function that is linear in the root of c, from `left` at root a to `right` at root b.
template <typename Value>
Value cosine_weighted_integral(float a, float b, Value left, Value right) {
  // 2 c dc = 4 t^3 dt with t the root.
  const float a4 = sqr(sqr(a)), b4 = sqr(sqr(b));
  const float whole = b4 - a4;
  const float weight_right = (0.8f * (b4 * b - a4 * a) - a * whole) / (b - a);
  return (whole - weight_right) * left + weight_right * right;
}

}  // namespace candil
