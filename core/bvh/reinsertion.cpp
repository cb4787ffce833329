#include "core/bvh/reinsertion.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace candil {
namespace {

/// Each round looks for better places for the largest of all nodes: they are in the way of most rays. Rounds end when
/// they gain less than this part of the cost.
constexpr std::size_t parts_per_round = 2;
constexpr int max_rounds = 40;
constexpr double least_gain = 0.0005;

/// In the order of a walk through the tree, which is the same wherever the nodes are in memory. Siblings are
/// neighbours: 2 k and 2 k + 1; the root is 0, and 1 is not used.
struct Node {
  FlippedBox box;
  std::uint32_t parent = 0;
  std::uint32_t left = 0;   // 0: a leaf
  std::uint32_t first = 0;  // of a leaf: into the references
  std::uint32_t count = 0;

  bool is_leaf() const { return left == 0; }
};

struct Move {
  std::uint32_t node = 0, target = 0;  // whose new sibling it becomes
  float gain = 0;                      // in half areas
};

FlippedBox join(FlippedBox a, FlippedBox b) {
  a.add(b);
  return a;
}

class Tree {
 public:
  explicit Tree(const BinaryNodes& nodes) : list_(2) {
    pairs_.push_back(0);
    list_[0] = content(nodes[0]);
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (list_[i].is_leaf()) continue;
      const std::uint32_t pair = list_[i].left;  // still that of `nodes`
      pairs_.push_back(pair);
      list_[i].left = static_cast<std::uint32_t>(list_.size());
      for (std::uint32_t k = 0; k < 2; ++k) {
        list_.push_back(content(nodes[pair + k]));
        list_.back().parent = static_cast<std::uint32_t>(i);
      }
    }
  }

  /// Whether anything was gained.
  bool improve() {
    double cost = measure().area;
    bool is_better = false;
    for (int round = 0; round < max_rounds; ++round) {
      std::vector<Node> before = list_;
      apply(find_moves());
      const Measure now = measure();
      if (!(now.area < cost) || now.depth > max_binary_depth) {
        list_ = std::move(before);
        break;
      }
      is_better = true;
      if (now.area > (1 - least_gain) * cost) break;
      cost = now.area;
    }
    return is_better;
  }

  /// Into the places that the nodes came from, if the wide tree costs less by that.
  void write(const BinaryNodes& nodes, std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
             const TreeSettings& settings) {
    const std::vector<std::uint32_t> downwards = order();
    std::vector<CollapseCosts> costs(list_.size());
    for (auto at = downwards.rbegin(); at != downwards.rend(); ++at) {
      Node& node = list_[*at];
      if (!node.is_leaf()) node.count = list_[node.left].count + list_[node.left + 1].count;
      costs[*at] = node.is_leaf() ? leaf_costs(node.box, node.count, settings)
                                  : inner_costs(node.box, node.count, costs[node.left], costs[node.left + 1], settings);
    }
    if (!(costs[0][0] < nodes[0].cost[0])) return;
    std::copy(refs.begin(), refs.end(), scratch.begin());
    std::uint32_t next = 0;
    for (const std::uint32_t i : downwards) {
      const Node& from = list_[i];
      BinaryNode& node = nodes[place(i)];
      node.set(from.box, next, from.count);
      node.left = from.is_leaf() ? 0 : place(from.left);
      node.cost = costs[i];
      if (!from.is_leaf()) continue;
      std::copy_n(&scratch[from.first], from.count, &refs[next]);
      next += from.count;
    }
  }

 private:
  static Node content(const BinaryNode& node) { return {node.box(), 0, node.left, node.first(), node.count()}; }
  std::uint32_t place(std::uint32_t i) const { return pairs_[i / 2] + i % 2; }
  static std::uint32_t sibling(std::uint32_t i) { return i ^ 1; }

  /// All nodes, parents before their children, left before right.
  std::vector<std::uint32_t> order() const {
    std::vector<std::uint32_t> result, stack = {0};
    result.reserve(list_.size());
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      result.push_back(i);
      if (!list_[i].is_leaf()) stack.push_back(list_[i].left + 1), stack.push_back(list_[i].left);
    }
    return result;
  }

  struct Measure {
    double area = 0;  // of all inner nodes, halved
    int depth = 0;
  };
  Measure measure() const {
    Measure sum;
    std::vector<std::pair<std::uint32_t, int>> stack = {{0, 0}};
    while (!stack.empty()) {
      const auto [i, depth] = stack.back();
      stack.pop_back();
      sum.depth = std::max(sum.depth, depth);
      if (list_[i].is_leaf()) continue;
      sum.area += list_[i].box.half_area();
      stack.emplace_back(list_[i].left, depth + 1), stack.emplace_back(list_[i].left + 1, depth + 1);
    }
    return sum;
  }

  /// The best of each candidate, best first.
  std::vector<Move> find_moves() const {
    std::vector<std::pair<float, std::uint32_t>> candidates;
    for (std::uint32_t i = 2; i < list_.size(); ++i) {
      if (list_[i].parent != 0) candidates.emplace_back(-list_[i].box.half_area(), i);
    }
    const std::size_t count = std::min(candidates.size(), candidates.size() / parts_per_round + 64);
    std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end());
    std::vector<Move> moves(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 32), [&](const auto& range) {
      std::vector<std::pair<float, std::uint32_t>> stack;
      for (std::size_t i = range.begin(); i < range.end(); ++i) moves[i] = find_move(candidates[i].second, stack);
    });
    std::erase_if(moves, [](const Move& move) { return !(move.gain > 0); });
    std::ranges::sort(moves,
                      [](const Move& a, const Move& b) { return std::tie(b.gain, a.node) < std::tie(a.gain, b.node); });
    return moves;
  }

  /// The search goes up from the node. At each ancestor (the pivot) it looks into the half that the node is not in, as
  /// long as what is gained by taking the node out, less what it adds on the way down, can be the best.
  Move find_move(std::uint32_t node, std::vector<std::pair<float, std::uint32_t>>& stack) const {
    const FlippedBox box = list_[node].box;
    const float area = box.half_area();
    Move best{node, 0, 0};
    FlippedBox without = list_[sibling(node)].box;  // the pivot's box without the node
    std::uint32_t pivot = list_[node].parent;
    float gain = list_[pivot].box.half_area();  // the parent goes away
    for (std::uint32_t below = node;; below = pivot, pivot = list_[pivot].parent) {
      stack.emplace_back(gain, sibling(below));
      while (!stack.empty()) {
        const auto [left, at] = stack.back();
        stack.pop_back();
        if (!(left - area > best.gain)) continue;
        const Node& there = list_[at];
        const float joined = join(there.box, box).half_area();
        if (left - joined > best.gain) best.gain = left - joined, best.target = at;
        if (there.is_leaf()) continue;
        const float further = left + there.box.half_area() - joined;
        stack.emplace_back(further, there.left), stack.emplace_back(further, there.left + 1);
      }
      if (pivot == 0) break;
      if (below == node) continue;
      without.add(list_[sibling(below)].box);  // beyond the pivot it is smaller
      gain += list_[pivot].box.half_area() - without.half_area();
    }
    return best;
  }

  void apply(const std::vector<Move>& moves) {
    std::vector<bool> is_changed(list_.size());
    for (const Move& move : moves) {
      const std::uint32_t parent = list_[move.node].parent;
      const std::uint32_t concerned[] = {move.node,   sibling(move.node),   parent,
                                         move.target, list_[parent].parent, list_[move.target].parent};
      if (std::ranges::any_of(concerned, [&](std::uint32_t i) { return is_changed[i]; })) continue;
      if (is_inside(move.target, move.node)) continue;
      for (const std::uint32_t i : concerned) is_changed[i] = true;
      carry_out(move);
    }
  }
  /// Other moves may have brought it there.
  bool is_inside(std::uint32_t i, std::uint32_t subtree) const {
    for (; i != 0; i = list_[i].parent) {
      if (i == subtree) return true;
    }
    return false;
  }
  void put(const Node& content, std::uint32_t at) {
    const std::uint32_t parent = list_[at].parent;
    list_[at] = content;
    list_[at].parent = parent;
    if (content.is_leaf()) return;
    list_[content.left].parent = at, list_[content.left + 1].parent = at;
  }
  void refit(std::uint32_t i) {
    for (;; i = list_[i].parent) {
      list_[i].box = join(list_[list_[i].left].box, list_[list_[i].left + 1].box);
      if (i == 0) return;
    }
  }
  /// The sibling takes the place of the parent, which frees a pair of neighbours but for the node itself. The target
  /// goes there too, and what was its place becomes the parent of both.
  void carry_out(const Move& move) {
    const std::uint32_t free = sibling(move.node), parent = list_[move.node].parent;
    put(Node(list_[free]), parent);
    if (parent != 0) refit(list_[parent].parent);
    put(Node(list_[move.target]), free);
    Node& joint = list_[move.target];
    joint.left = move.node & ~1U, joint.first = joint.count = 0;
    list_[move.node].parent = list_[free].parent = move.target;
    refit(move.target);
  }

  std::vector<Node> list_;
  std::vector<std::uint32_t> pairs_;  // where each pair is in the tree that this was made from
};

}  // namespace

void reinsert_subtrees(BinaryNodes& nodes, std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
                       const TreeSettings& settings) {
  Tree tree(nodes);
  if (tree.improve()) tree.write(nodes, refs, scratch, settings);
}

}  // namespace candil
