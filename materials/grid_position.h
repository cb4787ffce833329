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

}  // namespace candil
