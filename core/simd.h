/// Numbers in vector registers, for the code that every ray runs through: GLM works component by component.
#pragma once

#include "core/affine.h"

namespace candil {

/// Eight integers, or numbers, that are worked on together: one of eight samples, or of four samples twice, in each
/// lane.
using Lanes = std::uint32_t __attribute__((vector_size(32)));
using FloatLanes = float __attribute__((vector_size(32)));

/// A Vec3. Lane 3 is not used; it is kept finite.
using Float4 = float __attribute__((vector_size(16)));

inline Float4 to_lanes(Vec3 v) { return Float4{v.x, v.y, v.z, 0}; }
inline Vec3 to_vec3(Float4 v) { return {v[0], v[1], v[2]}; }
inline Float4 splat(float x) { return Float4{x, x, x, x}; }

inline Float4 absolute(Float4 v) { return v < 0 ? -v : v; }
inline Float4 maximum(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 minimum(Float4 a, Float4 b) { return a < b ? a : b; }
inline float max_component(Float4 v) { return glm::max(glm::max(v[0], v[1]), v[2]); }
inline float min_component(Float4 v) { return glm::min(glm::min(v[0], v[1]), v[2]); }
inline float dot(Float4 a, Float4 b) {
  const Float4 product = a * b;
  return product[0] + product[1] + product[2];
}
/// (y, z, x) of each.
inline Float4 rotate_lanes(Float4 v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); }
inline Float4 cross(Float4 a, Float4 b) { return rotate_lanes(a * rotate_lanes(b) - rotate_lanes(a) * b); }

/// Columns of a matrix.
struct Float4x3 {
  Float4 x, y, z;
  explicit Float4x3(const Mat3& m) : x(to_lanes(m[0])), y(to_lanes(m[1])), z(to_lanes(m[2])) {}
  Float4x3(Float4 column_x, Float4 column_y, Float4 column_z) : x(column_x), y(column_y), z(column_z) {}
  Float4 operator*(Float4 v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

/// The matrix whose rows are the three vectors: lane i of each column is of the i-th; lane 3 repeats lane 2.
inline Float4x3 from_rows(Float4 a, Float4 b, Float4 c) {
  const Float4 xy = __builtin_shufflevector(a, b, 0, 4, 1, 5), z = __builtin_shufflevector(a, b, 2, 6, 2, 6);
  return {__builtin_shufflevector(xy, c, 0, 1, 4, 4), __builtin_shufflevector(xy, c, 2, 3, 5, 5),
          __builtin_shufflevector(z, c, 0, 1, 6, 6)};
}

}  // namespace candil
