#include "core/bvh/binned_build.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/bvh/sah_bins.h"

namespace candil {
namespace {

using namespace sah;

/// Ranges of more items are binned and partitioned by several threads.
constexpr std::size_t wide_range = 1 << 15;
/// Ranges of at most so many are one task.
constexpr std::size_t task_range = 1 << 12;
/// Below this depth ranges are halved: 29 times at most until one item is left.
constexpr int last_free_depth = max_tree_depth - 32;

/// Moves the items that are left to the front, in stable order, which is one order however the threads share the work.
/// Returns how many they are.
template <typename IsLeft>
std::size_t partition_in_parallel(std::span<Item> items, std::span<Item> scratch, const IsLeft& is_left, Range& left,
                                  Range& right) {
  constexpr std::size_t chunk_size = wide_range / 4;
  struct Chunk {
    Range left, right;
    std::size_t left_count = 0, left_target = 0;
  };
  std::vector<Chunk> chunks((items.size() + chunk_size - 1) / chunk_size);
  const auto for_each = [&](const auto& work) {
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      const std::size_t begin = c * chunk_size;
      work(chunks[c], begin, std::min(begin + chunk_size, items.size()));
    });
  };
  for_each([&](Chunk& chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool goes_left = is_left(items[i]);
      (goes_left ? chunk.left : chunk.right).add(items[i]);
      chunk.left_count += goes_left;
    }
  });
  std::size_t left_count = 0;
  for (Chunk& chunk : chunks) {
    chunk.left_target = left_count;
    left_count += chunk.left_count;
    left.add(chunk.left), right.add(chunk.right);
  }
  for_each([&](const Chunk& chunk, std::size_t begin, std::size_t end) {
    std::size_t left_target = chunk.left_target, right_target = left_count + begin - chunk.left_target;
    for (std::size_t i = begin; i < end; ++i) scratch[is_left(items[i]) ? left_target++ : right_target++] = items[i];
  });
  for_each([&](const Chunk&, std::size_t begin, std::size_t end) {
    std::copy(scratch.begin() + static_cast<std::ptrdiff_t>(begin), scratch.begin() + static_cast<std::ptrdiff_t>(end),
              items.begin() + static_cast<std::ptrdiff_t>(begin));
  });
  return left_count;
}

/// The largest coordinate of boxes: sums and differences of two stay finite.
constexpr float largest = 0x1p125f;

/// Part of a tree: a leaf, a whole subtree that one task has built, or a pair of further branches.
struct Branch {
  Range range;
  NodeLink leaf;                // where `pairs` is empty and there are no children
  std::vector<NodePair> pairs;  // links count from its own start
  std::unique_ptr<Branch> children[2];
  std::size_t first_pair = 0;  // of the final tree
};

class Builder {
 public:
  Builder(std::span<const Bounds> boxes, const BinnedBuildOptions& options);
  BinaryTree build();

 private:
  struct Halves {
    Range left, right;
  };
  /// Nothing if the range is to be a leaf.
  std::optional<Halves> split(const Range& range, int depth);
  Split find_split(const Range& range, const Binning& binning) const;
  Halves partition(const Range& range, const Split& split, const Binning& binning);
  Halves halve(const Range& range);
  void bound(Range& range) const;
  std::unique_ptr<Branch> grow(const Range& range, int depth);
  NodeLink build_serially(const Range& range, int depth, std::vector<NodePair>& pairs);

  BinnedBuildOptions options_;
  std::vector<Item> items_, scratch_;
};

Builder::Builder(std::span<const Bounds> boxes, const BinnedBuildOptions& options)
    : options_(options), items_(boxes.size()) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), wide_range), [&](const auto& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) {
      // Not numbers become the whole of space.
      const Float4 low = to_lanes(boxes[i].low), high = to_lanes(boxes[i].high);
      Item& item = items_[i];
      item.low = low > -largest ? (low < largest ? low : splat(largest)) : splat(-largest);
      item.high = high < largest ? (high > -largest ? high : splat(-largest)) : splat(largest);
      item.low[3] = std::bit_cast<float>(static_cast<std::uint32_t>(i));
    }
  });
}

void Builder::bound(Range& range) const {
  for (std::size_t i = range.begin; i < range.end; ++i) range.add(items_[i]);
}

Split Builder::find_split(const Range& range, const Binning& binning) const {
  const auto fill = [&](std::size_t begin, std::size_t end, Bins bins) {
    for (std::size_t i = begin; i < end; ++i) bins.add(items_[i], binning);
    return bins;
  };
  if (range.size() <= wide_range) return fill(range.begin, range.end, Bins(binning.count)).best(binning, options_);
  // The order in which bins are united does not matter: they hold numbers of items, minima and maxima.
  const Bins bins = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(range.begin, range.end, wide_range / 4), Bins(binning.count),
      [&](const auto& part, Bins sum) { return fill(part.begin(), part.end(), std::move(sum)); },
      [](Bins a, const Bins& b) {
        a.add(b);
        return a;
      });
  return bins.best(binning, options_);
}

Builder::Halves Builder::partition(const Range& range, const Split& split, const Binning& binning) {
  const auto is_left = [&](const Item& item) { return binning.bin_of(item, split.axis) <= split.bin; };
  Halves halves;
  std::size_t middle = range.begin, end = range.end;
  if (range.size() <= wide_range) {
    while (middle < end) {
      Item& item = items_[middle];
      if (is_left(item)) {
        halves.left.add(item);
        ++middle;
      } else {
        halves.right.add(item);
        std::swap(item, items_[--end]);
      }
    }
  } else {
    middle = partition_in_parallel(std::span(items_).subspan(range.begin, range.size()),
                                   std::span(scratch_).subspan(range.begin, range.size()), is_left, halves.left,
                                   halves.right) +
             range.begin;
  }
  halves.left.begin = range.begin, halves.left.end = middle;
  halves.right.begin = middle, halves.right.end = range.end;
  return halves;
}

Builder::Halves Builder::halve(const Range& range) {
  const Float4 extent = range.centers.extent();
  const int axis = extent[0] > extent[1] ? (extent[0] > extent[2] ? 0 : 2) : (extent[1] > extent[2] ? 1 : 2);
  const std::size_t middle = range.begin + range.size() / 2;
  const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.begin), at(middle), at(range.end),
                   [&](const Item& a, const Item& b) { return a.center()[axis] < b.center()[axis]; });
  Halves halves{{range.begin, middle, {}, {}}, {middle, range.end, {}, {}}};
  bound(halves.left), bound(halves.right);
  return halves;
}

std::optional<Builder::Halves> Builder::split(const Range& range, int depth) {
  if (range.size() <= 1) return std::nullopt;
  if (depth >= last_free_depth) {
    if (range.size() <= options_.max_leaf) return std::nullopt;
    return halve(range);
  }
  const Binning binning(range.centers, options_.bins);
  const Split best = find_split(range, binning);
  if (range.size() <= options_.max_leaf) {
    const float area = range.box.area();
    if (!(area + best.cost < area * leaf_cost(range.size(), options_))) return std::nullopt;
  }
  return best.axis < 0 ? halve(range) : partition(range, best, binning);
}

NodeLink Builder::build_serially(const Range& range, int depth, std::vector<NodePair>& pairs) {
  const std::optional<Halves> halves = split(range, depth);
  if (!halves) return NodeLink::leaf(static_cast<std::uint32_t>(range.begin), static_cast<std::uint32_t>(range.size()));
  const std::size_t pair = pairs.size();
  pairs.emplace_back();
  const NodeLink left = build_serially(halves->left, depth + 1, pairs);
  const NodeLink right = build_serially(halves->right, depth + 1, pairs);
  pairs[pair].set(0, halves->left.box.bounds(), left);
  pairs[pair].set(1, halves->right.box.bounds(), right);
  return NodeLink::pair(static_cast<std::uint32_t>(pair));
}

std::unique_ptr<Branch> Builder::grow(const Range& range, int depth) {
  auto branch = std::make_unique<Branch>();
  branch->range = range;
  if (range.size() <= task_range) {
    branch->leaf = build_serially(range, depth, branch->pairs);
    return branch;
  }
  const Halves halves = *split(range, depth);
  tbb::parallel_invoke([&] { branch->children[0] = grow(halves.left, depth + 1); },
                       [&] { branch->children[1] = grow(halves.right, depth + 1); });
  return branch;
}

/// Branches in the order of their pairs in the tree; returns the number of pairs.
std::size_t lay_out(Branch& branch, std::size_t next, std::vector<Branch*>& order) {
  order.push_back(&branch);
  branch.first_pair = next;
  if (!branch.children[0]) return next + branch.pairs.size();
  return lay_out(*branch.children[1], lay_out(*branch.children[0], next + 1, order), order);
}

NodeLink link_to(const Branch& branch) {
  if (!branch.children[0] && branch.pairs.empty()) return branch.leaf;
  return NodeLink::pair(static_cast<std::uint32_t>(branch.first_pair));
}

void copy_pairs(const Branch& branch, std::vector<NodePair>& pairs) {
  const std::size_t first = branch.first_pair;
  for (int i = 0; i < 2 && branch.children[0]; ++i) {
    pairs[first].set(i, branch.children[i]->range.box.bounds(), link_to(*branch.children[i]));
  }
  for (std::size_t i = 0; i < branch.pairs.size(); ++i) {
    NodePair pair = branch.pairs[i];
    for (NodeLink& link : pair.links) {
      if (!link.is_leaf()) link = NodeLink::pair(link.index() + static_cast<std::uint32_t>(first));
    }
    pairs[first + i] = pair;
  }
}

BinaryTree Builder::build() {
  BinaryTree tree;
  if (items_.empty()) return tree;
  Range all{0, items_.size(), {}, {}};
  bound(all);
  if (items_.size() > wide_range) scratch_.resize(items_.size());
  const std::unique_ptr<Branch> root = grow(all, 0);
  std::vector<Branch*> branches;
  tree.pairs.resize(std::max<std::size_t>(1, lay_out(*root, 0, branches)));
  tbb::parallel_for(std::size_t{0}, branches.size(), [&](std::size_t i) { copy_pairs(*branches[i], tree.pairs); });
  if (link_to(*root).is_leaf()) tree.pairs[0].set(0, all.box.bounds(), root->leaf);
  tree.order.resize(items_.size());
  for (std::size_t i = 0; i < items_.size(); ++i) tree.order[i] = items_[i].id();
  return tree;
}

}  // namespace

BinaryTree build_binned(std::span<const Bounds> boxes, const BinnedBuildOptions& options) {
  if (boxes.size() > NodeLink::max_index) throw std::length_error("too many primitives for one hierarchy");
  return Builder(boxes, options).build();
}

}  // namespace candil
