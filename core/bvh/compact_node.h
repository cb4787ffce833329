/// A node of eight children whose boxes are rounded outwards to 8 bits per plane: 96 bytes, two cache lines instead of
/// four. Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs",
/// section 4.1.
#pragma once

#include <utility>

#include "core/bvh/large_buffer.h"
#include "core/bvh/wide_node.h"

namespace candil {

struct alignas(32) CompactNode {
  /// The plane q along an axis is at low + step * q, where a step is a power of two.
  float low[3];
  /// The exponents of the three steps as floats have them (plus 127); the fourth byte makes a normal number of all.
  std::uint8_t exponents[4];
  std::uint8_t planes[6][lane_count];  ///< In the order of WideNode's.
  std::uint32_t child[lane_count];     ///< Like WideNode's, or `no_child`.

  static constexpr std::uint32_t leaf_bit = WideNode::leaf_bit, no_child = 0xffffffff;

  CompactNode() = default;
  /// Every plane is where that of `wide` is, or further outside.
  explicit CompactNode(const WideNode& wide);
};
static_assert(sizeof(CompactNode) == 96);

inline namespace CANDIL_TARGET {

/// Of which these are the exponents.
inline Float4 powers_of_two(const std::uint8_t (&exponents)[4]) {
  using Int4 = std::int32_t __attribute__((vector_size(16)));
  return std::bit_cast<Float4>(Int4{exponents[0], exponents[1], exponents[2], 0} << 23);
}

/// See the one of WideNode. What a plane's t is off by, added to what WideRay lists (in its letters):
/// - step * r is exact: the step is a power of two. (Below the normal numbers it is not, but steps are 2^-64 at least.)
/// - low * r + near rounds to 1 u |r| L where it is fused, else also the product, to u |r| (|o| + L);
/// - q times the former plus the latter rounds to u |r| L, else also the product, to 2 u |r| L.
/// Together with the roundings of r and o r, which are 2 u |r| |o| + u |r| L, all of it is |r| (3 u |o| + 6 u L) at
/// most. With the 6 u L of the triangle test and the 2 u L of small components this is |r| (3 u |o| + 14 u L), within
/// WideRay's margin of |r| (4 u |o| + 16 u L). L grows by less than 1/60: no plane is further out than one step beyond
/// the boxes of the node, whose extent is at most 2 L and at least 127 steps.
inline Int8 enter_children(const CompactNode& node, const WideRay& ray, float t_max) {
  Float4 low;
  std::memcpy(&low, node.low, sizeof low);  // with the exponents in the lane that nobody reads
  const Float4 step = powers_of_two(node.exponents) * ray.reciprocal;
  const Float4 near_base = low * ray.reciprocal + ray.near, far_base = low * ray.reciprocal + ray.far;
  const char* const planes = reinterpret_cast<const char*>(node.planes);
  const auto crossing = [&](int axis, std::uint32_t offset, const Float4& base) {
    return bits8(multiply_add(load_bytes8(planes + offset), splat8(step[axis]), splat8(base[axis])));
  };
  constexpr std::uint32_t ratio = sizeof(float), other = WideRay::row_size / ratio;
  const std::uint32_t x = ray.near_offset[0] / ratio, y = ray.near_offset[1] / ratio, z = ray.near_offset[2] / ratio;
  const Int8 near = maximum(maximum(crossing(0, x, near_base), crossing(1, y, near_base)),
                            maximum(crossing(2, z, near_base), splat8(0)));
  const Int8 far = minimum(minimum(crossing(0, x ^ other, far_base), crossing(1, y ^ other, far_base)),
                           minimum(crossing(2, z ^ other, far_base), bits8(splat8(t_max))));
  Int8 child;
  std::memcpy(&child, node.child, sizeof child);
  return near | (near > far) | (child == splat8(static_cast<std::int32_t>(CompactNode::no_child)));
}

}  // namespace CANDIL_TARGET

/// Nodes of either kind from those that are built; on all threads of the calling task arena.
template <typename Node>
LargeBuffer<Node> nodes_from(LargeBuffer<WideNode> wide);
template <>
inline LargeBuffer<WideNode> nodes_from(LargeBuffer<WideNode> wide) {
  return wide;
}
template <>
LargeBuffer<CompactNode> nodes_from(LargeBuffer<WideNode> wide);

}  // namespace candil
