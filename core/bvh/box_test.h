/// Whether a ray meets an axis-aligned box: never a no where core/bvh/triangle_test.h would find a hit inside.
///
/// A hit of the triangle test has weights w_i of the rounded places of the vertices. Take the point of the ray at
/// t = sum w_i c_i / d_z (in the ray's frame; a_i, c_i are vertex minus origin along an axis of the plane and along the
/// shear axis). Along the shear axis it is where the weighted vertices are; along the other axes it is off by at most
/// sum w_i (2 u |a_i| + 4 u |s c_i|), u = 2^-24. If all a_i have one sign, sum w_i |a_i| = |sum w_i a_i|; if not, the
/// origin is between the vertices and it is at most the extent E of the triangle's box. The same holds for c_i. So the
/// point is outside of the box by at most
///     6 u |its distance from the origin along that axis| + 6 u E  (times 1 + O(u)).
/// - The second term, and its own rounding, is added to every box when it is made (`widened`).
/// - The first is relative: it changes the t of a slab by a factor 1 +- 6 u. Computing that t, fl(fl(lo - o) fl(1 /
/// d)),
///   adds 1 +- 3 u (Ize 2013, "Robust BVH Ray Traversal", section 3). A box is entered if near <= far (1 + 18 u); we
///   take 32 u (`far_slack`).
/// A direction of 0 makes t = +-infinity, or not a number where the origin is in the plane of a face: such a slab does
/// not limit the ray. That rests on minimum and maximum that keep the second of two values if one is not a number.
#pragma once

#include <cmath>

#include "core/ray.h"
#include "core/scene.h"

namespace candil {

/// Factor for the far end of a ray in a box.
inline constexpr float far_slack = 1 + 0x1p-19f;

/// `bounds` with the margin that the box test needs.
inline Bounds widened(const Bounds& bounds) {
  const float margin = 0x1p-21f * max_component(bounds.high - bounds.low);
  return {bounds.low - (margin + 0x1p-23f * glm::abs(bounds.low)),
          bounds.high + (margin + 0x1p-23f * glm::abs(bounds.high))};
}

/// The box of a triangle, with margin. Boxes of several are unions of these.
inline Bounds triangle_bounds(Vec3 a, Vec3 b, Vec3 c) {
  return widened({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
}

/// A ray as box tests want it.
struct SlabRay {
  Vec3 origin, inverse_direction;
  explicit SlabRay(const Ray& ray) : origin(ray.origin), inverse_direction(1.0f / ray.direction) {}
};

/// Whether the ray's line meets the box, at any t, also behind the origin.
inline bool is_met_by_line(const SlabRay& ray, const Bounds& box) {
  float near = -infinity, far = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const float t_low = (box.low[axis] - ray.origin[axis]) * ray.inverse_direction[axis];
    const float t_high = (box.high[axis] - ray.origin[axis]) * ray.inverse_direction[axis];
    const bool is_forwards = !std::signbit(ray.inverse_direction[axis]);
    const float t_in = is_forwards ? t_low : t_high, t_out = is_forwards ? t_high : t_low;
    near = t_in > near ? t_in : near;
    far = t_out < far ? t_out : far;
  }
  // The ends may be negative, and both infinite.
  return near <= far || near - far <= (far_slack - 1) * std::abs(far);
}

}  // namespace candil
