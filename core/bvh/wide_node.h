/// A node of a hierarchy with eight children, and a ray made ready for it.
#pragma once

#include <cmath>

#include "core/bvh/lanes.h"
#include "core/ray.h"
#include "core/scene.h"

namespace candil {

/// Boxes of up to eight children, plane by plane. Which plane of an axis a ray meets first depends on the sign of its
/// direction only, so that near and far planes are two loads, without a comparison.
struct alignas(32) WideNode {
  /// Low and high x, low and high y, low and high z. An unused child is inside out, from +infinity to -infinity.
  float planes[6][lane_count];
  /// Index of a node, or that of a leaf with `leaf_bit` set.
  std::uint32_t child[lane_count];

  static constexpr std::uint32_t leaf_bit = 0x80000000;
};
static_assert(sizeof(WideNode) == 224);

/// Constants of a ray such that `plane * reciprocal + near` bounds from below the t at which it crosses a plane, and
/// `plane * reciprocal + far` from above.
///
/// How far apart they have to be (u = 2^-24, o the origin, d the direction, r = 1/d, L the largest distance, along any
/// axis, from the origin to a plane):
/// - rounding r, -o r and the fused multiply-add moves t by at most u |r| (|o| + 3 L);
/// - a triangle's test rounds the difference of vertex and origin, and its edge functions, which moves the sideways
///   position of an edge by less than 8 u L (Ize 2013, "Robust BVH ray traversal", takes in the first part only): what
///   that test calls a hit has to lie in boxes along the way, or rays would leak at edges.
/// Twice 2^-20 |r| L + 2^-22 |r| |o| covers both, also where multiply and add are rounded separately.
///
/// A component of the direction below 2^-24 of the largest, D, is replaced by that: the ray moves by less than 2^-23 L
/// sideways within the hierarchy (where t < 2 L / D), and the above adds 2^-20 L; it also adds 16 L / D to t, more than
/// any t: a ray along a plane of a box is inside of it. No reciprocal is infinite, so that no 0 times infinity can lose
/// a box.
struct WideRay {
  /// `bounds` holds the whole hierarchy.
  WideRay(Vec3 origin, Vec3 direction, const Bounds& bounds) {
    const float largest = max_component(glm::abs(direction));
    const float reach = max_component(glm::max(glm::abs(bounds.low - origin), glm::abs(bounds.high - origin)));
    for (int axis = 0; axis < 3; ++axis) {
      const float component = std::copysign(glm::max(std::abs(direction[axis]), 0x1p-24f * largest), direction[axis]);
      reciprocal[axis] = 1 / component;
      const float product = -origin[axis] * reciprocal[axis];
      const float margin = std::abs(reciprocal[axis]) * (0x1p-20f * reach + 0x1p-22f * std::abs(origin[axis]));
      near[axis] = product - margin;
      far[axis] = product + margin;
      near_offset[axis] = static_cast<std::uint32_t>(sizeof(float[lane_count])) *
                          static_cast<std::uint32_t>(2 * axis + (std::signbit(component) ? 1 : 0));
    }
  }

  float reciprocal[3], near[3], far[3];
  std::uint32_t near_offset[3];  ///< Of the planes met first, bytes from the start of a node.
};

/// The t at which the ray enters each child's box, as the bits of a float that is not negative; all ones for a box that
/// it does not meet in [0, t_max].
/// Non-negative floats compare like their bits, which takes one cycle instead of four. Negative ones turn around among
/// themselves, but none of them is ever the answer: entering before 0 is entering at 0, leaving before 0 is a miss.
inline Int8 enter_children(const WideNode& node, const WideRay& ray, float t_max) {
  const char* const planes = reinterpret_cast<const char*>(&node);
  const auto crossing = [&](int axis, std::uint32_t offset, const float (&constant)[3]) {
    return bits8(multiply_add(load8(planes + offset), splat8(ray.reciprocal[axis]), splat8(constant[axis])));
  };
  constexpr auto other = static_cast<std::uint32_t>(sizeof(float[lane_count]));
  const Int8 near = maximum(maximum(crossing(0, ray.near_offset[0], ray.near), crossing(1, ray.near_offset[1], ray.near)),
                            maximum(crossing(2, ray.near_offset[2], ray.near), splat8(0)));
  const Int8 far =
      minimum(minimum(crossing(0, ray.near_offset[0] ^ other, ray.far), crossing(1, ray.near_offset[1] ^ other, ray.far)),
              minimum(crossing(2, ray.near_offset[2] ^ other, ray.far), bits8(splat8(t_max))));
  return near | (near > far);
}

}  // namespace candil
