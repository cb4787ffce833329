#include "core/bvh/wide_build.h"

#include <tbb/parallel_for.h>

#include <vector>

#include "core/bvh/reinsertion.h"

namespace candil {
namespace {

/// Part of the tree that one task makes; indices of nodes and leaves are its own until they are joined.
struct Part {
  std::uint32_t root = 0;  // of the binary tree
  std::vector<WideNode> nodes;
  std::vector<WideLeaf> leaves;
};

class Collapser {
 public:
  /// In WideNode::child: the root of a postponed part.
  static constexpr std::uint32_t postponed_bit = 0x40000000;

  Collapser(const BinaryNodes& binary, const TreeSettings& settings) : binary_(binary), settings_(settings) {}

  /// The wide nodes of the subtree, parents first. Subtrees of up to `postponed_size` primitives are left to others: an
  /// entry of `postponed` each, to which the child of the parent refers.
  void make(Part& part, std::uint32_t postponed_size, std::vector<Part>* postponed) const {
    part.nodes.emplace_back();
    expand(part, 0, part.root, postponed_size, postponed);
  }

 private:
  struct Children {
    std::uint32_t list[8];
    int count = 0;
  };
  /// The roots of the at most `limit` subtrees that the costs were computed for.
  void choose(std::uint32_t index, int limit, Children& children) const {
    const BinaryNode& node = binary_[index];
    while (limit > 1 && node.cost[limit - 1] == node.cost[limit - 2]) --limit;
    if (limit == 1 || node.is_leaf()) {
      children.list[children.count++] = index;
    } else {
      choose_below(node, limit, node.cost[limit - 1], children);
    }
  }
  void choose_below(const BinaryNode& node, int limit, float cost, Children& children) const {
    const BinaryNode& a = binary_[node.left];
    const BinaryNode& b = binary_[node.left + 1];
    int k = 1;
    while (k < limit - 1 && a.cost[k - 1] + b.cost[limit - k - 1] > cost) ++k;
    choose(node.left, k, children);
    choose(node.left + 1, limit - k, children);
  }
  bool is_leaf(const BinaryNode& node) const {
    // Costs may be infinite where boxes are very large.
    return node.is_leaf() ||
           (node.count() <= settings_.max_leaf_size && node.cost[0] == leaf_cost(node.box(), node.count(), settings_));
  }

  void expand(Part& part, std::size_t at, std::uint32_t index, std::uint32_t postponed_size,
              std::vector<Part>* postponed) const {
    const BinaryNode& node = binary_[index];
    Children children;
    if (is_leaf(node)) {  // only as the root of all
      children.list[children.count++] = index;
    } else {
      float least = infinity;
      for (int k = 1; k < 8; ++k)
        least = std::min(least, binary_[node.left].cost[k - 1] + binary_[node.left + 1].cost[8 - k - 1]);
      choose_below(node, 8, least, children);
    }
    std::size_t inner = part.nodes.size();  // inner children get neighbouring places
    for (int i = 0; i < 8; ++i) {
      WideNode& wide = part.nodes[at];
      const bool is_used = i < children.count;
      const FlippedBox box = is_used ? binary_[children.list[i]].box() : FlippedBox();
      for (int axis = 0; axis < 3; ++axis) {
        wide.planes[2 * axis][i] = box.low(axis);
        wide.planes[2 * axis + 1][i] = box.high(axis);
      }
      wide.child[i] = WideNode::leaf_bit;
      if (!is_used) continue;
      const BinaryNode& child = binary_[children.list[i]];
      if (is_leaf(child)) {
        wide.child[i] = WideNode::leaf_bit | static_cast<std::uint32_t>(part.leaves.size());
        part.leaves.push_back({child.first(), child.count()});
      } else if (child.count() <= postponed_size) {
        wide.child[i] = postponed_bit | static_cast<std::uint32_t>(postponed->size());
        postponed->emplace_back().root = children.list[i];
      } else {
        wide.child[i] = static_cast<std::uint32_t>(part.nodes.size());
        part.nodes.emplace_back();
      }
    }
    for (int i = 0; i < children.count; ++i) {
      if (part.nodes[at].child[i] & (WideNode::leaf_bit | postponed_bit)) continue;
      expand(part, inner++, children.list[i], postponed_size, postponed);
    }
  }

  const BinaryNodes& binary_;
  const TreeSettings& settings_;
};

}  // namespace

WideTree build_wide_tree(std::span<PrimitiveRef> refs, const TreeSettings& settings) {
  WideTree tree;
  if (refs.empty()) {
    tree.nodes = LargeBuffer<WideNode>(1);
    WideNode& root = tree.nodes[0];
    for (int i = 0; i < 6; ++i) std::fill_n(root.planes[i], 8, i % 2 == 0 ? infinity : -infinity);
    std::fill_n(root.child, 8, WideNode::leaf_bit);
    tree.bounds.add(Vec3(0));
    return tree;
  }
  LargeBuffer<PrimitiveRef> scratch(refs.size());
  BinaryNodes binary(refs.size());
  build_binary_tree(binary, refs, {scratch.data(), scratch.size()}, settings);
  if (settings.moves_subtrees) reinsert_subtrees(binary, refs, {scratch.data(), scratch.size()}, settings);
  const FlippedBox box = binary[0].box();
  tree.bounds = {Vec3(box.low(0), box.low(1), box.low(2)), Vec3(box.high(0), box.high(1), box.high(2))};

  // The top by one thread, about 256 subtrees by tasks, then all of it into one array.
  const Collapser collapser(binary, settings);
  std::vector<Part> parts(1);
  std::vector<Part> subtrees;
  const std::uint32_t subtree_size = std::max<std::uint32_t>(static_cast<std::uint32_t>(refs.size() / 256), 1024);
  collapser.make(parts[0], refs.size() <= subtree_size ? 0 : subtree_size, &subtrees);
  std::move(subtrees.begin(), subtrees.end(), std::back_inserter(parts));
  tbb::parallel_for(std::size_t{1}, parts.size(), [&](std::size_t i) { collapser.make(parts[i], 0, nullptr); });

  std::vector<std::uint32_t> first_node(parts.size() + 1), first_leaf(parts.size() + 1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    first_node[i + 1] = first_node[i] + static_cast<std::uint32_t>(parts[i].nodes.size());
    first_leaf[i + 1] = first_leaf[i] + static_cast<std::uint32_t>(parts[i].leaves.size());
  }
  tree.nodes = LargeBuffer<WideNode>(first_node.back());
  tree.leaves = LargeBuffer<WideLeaf>(first_leaf.back());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    for (WideNode& node : parts[i].nodes) {
      for (std::uint32_t& child : node.child) {
        if (child & WideNode::leaf_bit) {
          child += first_leaf[i];
        } else if (child & Collapser::postponed_bit) {
          child = first_node[1 + (child ^ Collapser::postponed_bit)];
        } else {
          child += first_node[i];
        }
      }
    }
    std::copy(parts[i].nodes.begin(), parts[i].nodes.end(), tree.nodes.begin() + first_node[i]);
    std::copy(parts[i].leaves.begin(), parts[i].leaves.end(), tree.leaves.begin() + first_leaf[i]);
  });
  return tree;
}

}  // namespace candil
