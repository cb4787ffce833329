/// The way of a ray through a hierarchy of WideNodes or CompactNodes.
#pragma once

#include "core/bvh/wide_node.h"

namespace candil {
inline namespace CANDIL_TARGET {

/// No tree is deeper: see max_binary_depth in core/bvh/binary_build.h.
inline constexpr int max_wide_depth = 80;

/// Calls `leaf(index, t_max)` for the leaves whose box the ray meets in [0, t_max], near ones first; it lowers t_max
/// when it finds a hit, and what lies behind is left out. `nodes` has one at least.
///
/// The children of a node that are still to be visited are one entry of the stack: eight 16-bit keys of distance, whose
/// smallest one instruction finds (phminposuw). So nodes are visited in the order of distance without sorting, with the
/// same instructions however many children are hit: nothing to mispredict. The depth of the tree bounds the stack.
template <typename Node, typename Leaf>
void visit_nearest_first(const Node* nodes, const WideRay& ray, float& t_max, const Leaf& leaf) {
  struct Entry {
    Keys8 keys;
    const Node* node;
    unsigned left;  // bits of the children to come
  };
  Entry stack[max_wide_depth];
  Entry* top = stack;
  const Node* node = nodes;
  unsigned t_key = std::bit_cast<std::uint32_t>(t_max) >> 16;
  for (;;) {
    const Int8 enter = enter_children(*node, ray, t_max);
    Keys8 keys = make_keys(enter);
    unsigned left = sign_bits(enter) ^ 0xff;
    for (;;) {
      const NearestKey nearest = nearest_key(keys);
      if (nearest.key <= t_key) {
        left &= ~(1U << nearest.lane);
        *top = {without_lane(keys, nearest.lane), node, left};
        top += left != 0;
        const std::uint32_t child = node->child[nearest.lane];
        if ((child & Node::leaf_bit) == 0) {
          node = nodes + child;
          break;
        }
        leaf(child ^ Node::leaf_bit, t_max);
        t_key = std::bit_cast<std::uint32_t>(t_max) >> 16;
      }
      if (top == stack) return;
      --top;
      keys = top->keys, node = top->node, left = top->left;
    }
  }
}

/// Whether `leaf(index)` is true for any leaf whose box the ray meets in [0, t_max]; stops at the first.
template <typename Node, typename Leaf>
bool visit_until(const Node* nodes, const WideRay& ray, float t_max, const Leaf& leaf) {
  struct Entry {
    const Node* node;
    unsigned left;
  };
  Entry stack[max_wide_depth];
  Entry* top = stack;
  const Node* node = nodes;
  for (;;) {
    unsigned left = sign_bits(enter_children(*node, ray, t_max)) ^ 0xff;
    for (;;) {
      if (left != 0) {
        const int lane = std::countr_zero(left);
        left &= left - 1;
        *top = {node, left};
        top += left != 0;
        const std::uint32_t child = node->child[lane];
        if ((child & Node::leaf_bit) == 0) {
          node = nodes + child;
          break;
        }
        if (leaf(child ^ Node::leaf_bit)) return true;
      }
      if (top == stack) return false;
      --top;
      node = top->node, left = top->left;
    }
  }
}

}  // namespace CANDIL_TARGET
}  // namespace candil
