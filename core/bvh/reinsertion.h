/// Makes a binary tree better by moving subtrees to where they cost less.
///
/// Bittner, Hapala and Havran 2013, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies", with the search
/// of Meister and Bittner 2018, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization": all moves of a round
/// are looked for in the same tree, in parallel; those that get in each other's way are left out, the better one stays.
///
/// Chosen over spatial splits (Stich, Friedrich and Dietrich 2009): no triangle is in two leaves, so that memory and
/// the number of blocks stay, and it repairs the top of the tree too, where splitting by bins is at its most short-
/// sighted.
#pragma once

#include <span>

#include "core/bvh/binary_build.h"

namespace candil {

/// `nodes` and `refs` are as build_binary_tree() leaves them, and are so again. The cost of the whole tree
/// (BinaryNode::cost) is never larger afterwards, nor its depth above max_binary_depth. `scratch` is as long as `refs`.
/// The tree does not depend on the number of threads.
void reinsert_subtrees(BinaryNodes& nodes, std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
                       const TreeSettings& settings);

}  // namespace candil
