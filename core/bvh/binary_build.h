/// A binary tree over boxes by the surface area heuristic: what a wide tree is collapsed from.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <span>
#include <vector>

#include "core/bvh/large_buffer.h"
#include "core/bvh/primitive_ref.h"

namespace candil {

/// Deeper splits halve the number of primitives instead of following the heuristic, which duplicates or a geometric
/// series of sizes could lead arbitrarily deep. So no tree over 2^31 primitives is deeper than max_binary_depth.
inline constexpr int max_heuristic_depth = 48;
inline constexpr int max_binary_depth = max_heuristic_depth + 31;

struct TreeSettings {
  /// Of visiting a leaf, however many primitives are in it; testing eight boxes costs 1.
  float leaf_cost = 0.6f;
  std::uint32_t max_leaf_size = 8;
  /// So few primitives are not split any further: they become a leaf. With 1 the costs decide about leaves.
  std::uint32_t unsplit_size = 8;
  int bins = 16;                ///< Per axis, at most max_bins.
  bool moves_subtrees = false;  ///< See core/bvh/reinsertion.h.
};

/// Least cost of a subtree as at most i + 1 children of one wide node: Ylitie, Karras and Laine 2017, "Efficient
/// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", section 3.1.
using CollapseCosts = std::array<float, 7>;

/// One cache line.
struct alignas(64) BinaryNode {
  /// Box; lane 3: the bits of the first primitive of the subtree, lane 7: those of their number.
  Float8 box_and_range;
  std::uint32_t left;  ///< Index of the first child, 0 for a leaf; the second child comes right behind.
  CollapseCosts cost;

  FlippedBox box() const { return FlippedBox(box_and_range); }  ///< Its lanes 3 and 7 are meaningless.
  std::uint32_t first() const { return static_cast<std::uint32_t>(bits8(box_and_range)[3]); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(bits8(box_and_range)[7]); }
  bool is_leaf() const { return left == 0; }
  void set(FlippedBox box, std::uint32_t first, std::uint32_t count) {
    box_and_range = box.v;
    box_and_range[3] = std::bit_cast<float>(first);
    box_and_range[7] = std::bit_cast<float>(count);
  }
};

/// Of any subtree as one leaf; infinity for too many primitives.
inline float leaf_cost(FlippedBox box, std::uint32_t count, const TreeSettings& settings) {
  return count <= settings.max_leaf_size ? settings.leaf_cost * box.half_area() : infinity;
}
inline CollapseCosts leaf_costs(FlippedBox box, std::uint32_t count, const TreeSettings& settings) {
  CollapseCosts costs;
  costs.fill(leaf_cost(box, count, settings));
  return costs;
}
/// From those of the children: with i children of one wide node to spend, give k to the left and the rest to the right;
/// with one, be a leaf or a wide node of eight.
CollapseCosts inner_costs(FlippedBox box, std::uint32_t count, const CollapseCosts& left, const CollapseCosts& right,
                          const TreeSettings& settings);

/// Room for as many nodes as it takes, in pieces. How many a tree has is known at its end only, and memory that was
/// touched for nothing costs more time than a node takes to fill.
class BinaryNodes {
 public:
  static constexpr std::uint32_t chunk = 64;  ///< Nodes that a task gets at a time.

  /// Room for as many as `primitives` can need: 2 n nodes, and one unfinished chunk for each task. Tasks are for more
  /// than 2048 primitives, of which a level of the tree has at most n / 2048: below max_binary_depth levels of them
  /// less than 3 n nodes.
  explicit BinaryNodes(std::size_t primitives) : pieces_(8 * primitives / piece_size + 2) {}
  BinaryNode& operator[](std::uint32_t i) const {
    return pieces_[i / piece_size].load(std::memory_order_acquire)[i % piece_size];
  }
  /// The first of `chunk` new nodes. For any thread.
  std::uint32_t new_chunk();

 private:
  static constexpr std::uint32_t piece_size = 1 << 14;  // 1 MB

  std::vector<std::atomic<BinaryNode*>> pieces_;
  std::vector<LargeBuffer<BinaryNode>> memory_;
  std::mutex growing_;
  std::atomic<std::uint32_t> next_{0};
};

/// Node 0 is the root. `refs` is brought into the order of the leaves; `scratch` is as long. At least one primitive.
/// Runs on all threads of the calling task arena; the tree does not depend on their number, the places of its nodes in
/// memory do.
void build_binary_tree(BinaryNodes& nodes, std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
                       const TreeSettings& settings);

}  // namespace candil
