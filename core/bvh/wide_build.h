/// Builds trees of eight children.
#pragma once

#include <span>

#include "core/bvh/binary_build.h"
#include "core/bvh/wide_node.h"

namespace candil {

/// So that all indices fit, whatever the tree looks like.
inline constexpr std::size_t max_primitives = std::size_t{1} << 29;

struct WideLeaf {
  std::uint32_t first, count;  ///< Into the sorted PrimitiveRefs.
};

struct WideTree {
  LargeBuffer<WideNode> nodes;  ///< The first is the root; at least one. Leaves are indices into `leaves`.
  LargeBuffer<WideLeaf> leaves;
  Bounds bounds;
};

/// `refs` is brought into the order of the leaves. Same tree, bit by bit, for any number of threads.
WideTree build_wide_tree(std::span<PrimitiveRef> refs, const TreeSettings& settings);

}  // namespace candil
