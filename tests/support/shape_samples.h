/// Shapes of all kinds and sizes, for tests that go through them all.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/scene.h"

namespace candil::test {

struct ShapeSample {
  std::string name;
  Shape shape;
};

inline void PrintTo(const ShapeSample& sample, std::ostream* stream) { *stream << sample.name; }

/// Every kind under every transform: moved, tiny, huge, stretched, sheared, mirrored, touching the world's origin, far
/// from it. The rounding of world coordinates is far below the size of each.
std::vector<ShapeSample> shape_samples();

/// A scene of that shape alone, of a double-sided material with a texture.
Scene scene_of(const Shape& shape);

}  // namespace candil::test
