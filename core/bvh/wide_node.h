/// A node of a hierarchy with eight children, and a ray made ready for it.
#pragma once

#include "core/bvh/lanes.h"
#include "core/ray.h"
#include "core/scene.h"
#include "core/simd.h"

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

inline namespace CANDIL_TARGET {

/// Constants of a ray such that `plane * reciprocal + near` bounds from below the t at which it crosses a plane, and
/// `plane * reciprocal + far` from above.
///
/// How far apart they are (u = 2^-24, o the origin, d the direction, r = 1/d, L the largest distance, along any axis,
/// from the origin to a plane):
/// - rounding r, -o r and the multiply-add moves t by at most |r| (2 u |o| + 4 u L), even where the latter is not
/// fused;
/// - the triangle test decides exactly, but about vertices whose places across the ray are off by up to 6 u L (see
///   core/bvh/triangle_test.h). Boxes on the way to what it calls a hit have to be wider by that; Ize 2013, "Robust BVH
///   Ray Traversal", leaves this part out.
/// A margin of |r| (4 u |o| + 16 u L) on either side covers both.
///
/// A component of the direction below 2^-24 of the largest, D, is replaced by that: the ray, which has t < 2 L / D
/// within the hierarchy, moves by less than 2 u L sideways, still within the margin. There the margin is more than 16 L
/// / D, so that a ray in the plane of a face is inside. No reciprocal is infinite, and no 0 times infinity can lose a
/// box.
struct WideRay {
  /// `bounds` holds the whole hierarchy.
  WideRay(const Ray& ray, const Bounds& bounds) {
    const Float4 o = to_lanes(ray.origin), d = to_lanes(ray.direction);
    const Float4 size = absolute(d);
    const Float4 least = splat(0x1p-24f * max_component(size));
    using Int4 = int __attribute__((vector_size(16)));
    const Int4 sign = std::bit_cast<Int4>(d) & Int4{INT32_MIN, INT32_MIN, INT32_MIN, 0};
    const Float4 component = std::bit_cast<Float4>(std::bit_cast<Int4>(size > least ? size : least) | sign);
    const Float4 r = 1 / component;
    // Qualified: those of eight lanes would hide it.
    const float reach =
        max_component(candil::maximum(absolute(to_lanes(bounds.low) - o), absolute(to_lanes(bounds.high) - o)));
    const Float4 margin = absolute(r) * (splat(0x1p-20f * reach) + 0x1p-22f * absolute(o));
    const Float4 product = o * r;
    reciprocal = r, near = -product - margin, far = margin - product;
    for (int axis = 0; axis < 3; ++axis) {
      near_offset[axis] = row_size * static_cast<std::uint32_t>(2 * axis) + (sign[axis] != 0 ? row_size : 0);
    }
  }

  static constexpr auto row_size = static_cast<std::uint32_t>(sizeof(float[lane_count]));
  Float4 reciprocal, near, far;
  std::uint32_t near_offset[3];  ///< Of the planes met first, bytes from the start of a node; the others: ^ row_size.
};

/// The t at which the ray enters each child's box, as the bits of a float that is not negative; all ones for a box that
/// it does not meet in [0, t_max].
/// Non-negative floats compare like their bits, which takes one cycle instead of four. Negative ones turn around among
/// themselves, but none of them is ever the answer: entering before 0 is entering at 0, leaving before 0 is a miss.
inline Int8 enter_children(const WideNode& node, const WideRay& ray, float t_max) {
  const char* const planes = reinterpret_cast<const char*>(&node);
  const auto crossing = [&](int axis, std::uint32_t offset, const Float4& constant) {
    return bits8(multiply_add(load8(planes + offset), splat8(ray.reciprocal[axis]), splat8(constant[axis])));
  };
  constexpr std::uint32_t other = WideRay::row_size;
  const Int8 near =
      maximum(maximum(crossing(0, ray.near_offset[0], ray.near), crossing(1, ray.near_offset[1], ray.near)),
              maximum(crossing(2, ray.near_offset[2], ray.near), splat8(0)));
  const Int8 far = minimum(
      minimum(crossing(0, ray.near_offset[0] ^ other, ray.far), crossing(1, ray.near_offset[1] ^ other, ray.far)),
      minimum(crossing(2, ray.near_offset[2] ^ other, ray.far), bits8(splat8(t_max))));
  return near | (near > far);
}

}  // namespace CANDIL_TARGET
}  // namespace candil
