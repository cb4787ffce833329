/// Builds a binary hierarchy top-down by the surface area heuristic over bins (Wald 2007, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies").
#pragma once

#include <span>
#include <vector>

#include "core/bvh/node_pair.h"

namespace candil {

struct BinnedBuildOptions {
  std::uint32_t bins = 16;     ///< Per axis, at most 64.
  std::uint32_t max_leaf = 4;  ///< Items of a leaf at most; at most NodeLink::max_items.
  float leaf_cost = 1;         ///< Of visiting a leaf, in units of visiting a pair of nodes.
};

struct BinaryTree {
  std::vector<NodePair> pairs;       ///< The first one is the root; none where there are no items.
  std::vector<std::uint32_t> order;  ///< Items in the order of the leaves, whose links point here.
};

/// In parallel on the calling task arena; the same tree for any number of threads. Whatever the boxes, no deeper than
/// max_tree_depth. Throws std::length_error for more items than a link can count.
BinaryTree build_binned(std::span<const Bounds> boxes, const BinnedBuildOptions& options);

}  // namespace candil
