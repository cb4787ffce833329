/// What a builder sorts: the boxes of primitives.
#pragma once

#include "core/bvh/lanes.h"
#include "core/scene.h"

namespace candil {

/// A box as (-low, high): lanes 0 to 2 and 4 to 6. Then one maximum joins two boxes, and what is empty is -infinity.
struct FlippedBox {
  Float8 v = splat8(-infinity);

  FlippedBox() = default;
  explicit FlippedBox(Float8 lanes) : v(lanes) {}
  explicit FlippedBox(const Bounds& b) : v{-b.low.x, -b.low.y, -b.low.z, 0, b.high.x, b.high.y, b.high.z, 0} {}
  void add(FlippedBox other) { v = maximum(v, other.v); }
  /// Half of the surface, which is what ratios of surfaces need. 0 for a point, -infinity or so for nothing.
  float half_area() const {
    const float x = v[0] + v[4], y = v[1] + v[5], z = v[2] + v[6];
    return x * (y + z) + y * z;
  }
  float low(int axis) const { return -v[axis]; }
  float high(int axis) const { return v[4 + axis]; }
};

/// A FlippedBox whose lane 3 holds the bits of the primitive's id.
struct alignas(32) PrimitiveRef {
  Float8 v;

  PrimitiveRef() = default;
  PrimitiveRef(FlippedBox box, std::uint32_t id) : v(box.v) {
    v[3] = std::bit_cast<float>(id);
    v[7] = 0;
  }
  std::uint32_t id() const { return static_cast<std::uint32_t>(bits8(v)[3]); }
  /// The id is masked out: its bits may be those of a denormal number.
  FlippedBox box() const { return FlippedBox(floats8(bits8(v) & Int8{-1, -1, -1, 0, -1, -1, -1, 0})); }
};
static_assert(sizeof(PrimitiveRef) == 32);

/// Twice the centre of a box, as the FlippedBox of a point.
inline FlippedBox doubled_center(FlippedBox box) {
#if CANDIL_AVX2
  return FlippedBox(box.v - Float8(_mm256_permute2f128_ps(box.v, box.v, 1)));
#else
  return FlippedBox(box.v - __builtin_shufflevector(box.v, box.v, 4, 5, 6, 7, 0, 1, 2, 3));
#endif
}

}  // namespace candil
