/// A binary tree over boxes by the surface area heuristic: what a wide tree is collapsed from.
#pragma once

#include <span>

#include "core/bvh/large_buffer.h"
#include "core/bvh/primitive_ref.h"

namespace candil {

/// Deeper splits halve the number of primitives instead of following the heuristic, which duplicates or a geometric
/// series of sizes could lead arbitrarily deep. So no tree over 2^31 primitives is deeper than max_binary_depth.
inline constexpr int max_heuristic_depth = 48;
inline constexpr int max_binary_depth = max_heuristic_depth + 31;

/// What visiting costs, in units of one test of eight boxes, and what a leaf may hold.
struct WideCosts {
  float leaf = 1;  ///< One leaf, however many primitives it holds.
  std::uint32_t max_leaf_size = 8;
};

/// One cache line.
struct alignas(64) BinaryNode {
  /// Box; lane 3: the bits of the first primitive of the subtree, lane 7: those of their number.
  Float8 box_and_range;
  std::uint32_t left;  ///< Index of the first child, 0 for a leaf; the second child comes right behind.
  /// Least cost of the subtree as at most i + 1 children of one wide node: Ylitie, Karras and Laine 2017, "Efficient
  /// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3.1.
  float cost[7];

  FlippedBox box() const { return FlippedBox(box_and_range); }  ///< Its lanes 3 and 7 are meaningless.
  std::uint32_t first() const { return static_cast<std::uint32_t>(bits8(box_and_range)[3]); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(bits8(box_and_range)[7]); }
  bool is_leaf() const { return left == 0; }
  float leaf_cost(const WideCosts& costs) const {
    return count() <= costs.max_leaf_size ? costs.leaf * box().half_area() : infinity;
  }
};

/// `refs` is brought into the order of the leaves; `scratch` is as long. At least one primitive. Runs on all threads of
/// the calling task arena; the tree does not depend on their number, the places of its nodes in memory do.
LargeBuffer<BinaryNode> build_binary_tree(std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
                                          const WideCosts& costs, std::uint32_t leaf_size);

}  // namespace candil
