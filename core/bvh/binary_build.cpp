#include "core/bvh/binary_build.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <vector>

#include "core/bvh/binary_bins.h"

namespace candil {
namespace {

/// Ranges above this many primitives are binned and split by several threads, in chunks of a fixed size, so that the
/// result does not depend on the threads; ranges above the last number become tasks.
constexpr std::size_t parallel_split_size = 1 << 16, chunk_size = 1 << 14, task_size = 1 << 11;

/// Primitives [first, first + count), with their boxes and doubled centres joined.
struct Range {
  std::uint32_t first, count;
  FlippedBox box, centers;
};

struct Halves {
  Range left, right;
};

class Builder {
 public:
  Builder(BinaryNodes& nodes, std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
          const TreeSettings& settings)
      : nodes_(nodes), refs_(refs), scratch_(scratch), settings_(settings) {}

  void build() {
    const auto whole = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, refs_.size(), chunk_size), Range{0, 0, {}, {}},
        [&](const auto& part, Range range) {
          for (const PrimitiveRef& ref : refs_.subspan(part.begin(), part.size())) {
            range.box.add(ref.box());
            range.centers.add(doubled_center(ref.box()));
          }
          return range;
        },
        [](Range a, const Range& b) {
          a.box.add(b.box), a.centers.add(b.centers);
          return a;
        });
    NodeSource source;
    const std::uint32_t root = new_pair(source);  // node 1 is not used
    build({0, static_cast<std::uint32_t>(refs_.size()), whole.box, whole.centers}, root, 0, false, source);
  }

 private:
  /// Of one task.
  struct NodeSource {
    std::uint32_t next = 0, end = 0;
  };
  std::uint32_t new_pair(NodeSource& source) {
    if (source.next == source.end) {
      source.next = nodes_.new_chunk();
      source.end = source.next + BinaryNodes::chunk;
    }
    source.next += 2;
    return source.next - 2;
  }

  /// The primitives of `range` are in refs_, or in scratch_ if `is_in_scratch`; afterwards they are in refs_.
  void build(const Range& range, std::uint32_t index, int depth, bool is_in_scratch, NodeSource& source) {
    BinaryNode& node = nodes_[index];
    node.set(range.box, range.first, range.count);
    if (range.count <= settings_.unsplit_size) {
      if (is_in_scratch) std::copy_n(&scratch_[range.first], range.count, &refs_[range.first]);
      node.left = 0;
      node.cost = leaf_costs(range.box, range.count, settings_);
      return;
    }
    const Halves halves = split(range, depth, is_in_scratch);
    const std::uint32_t left = node.left = new_pair(source);
    if (range.count > task_size) {
      tbb::parallel_invoke(
          [&] {
            NodeSource own;
            build(halves.left, left, depth + 1, !is_in_scratch, own);
          },
          [&] { build(halves.right, left + 1, depth + 1, !is_in_scratch, source); });
    } else {
      build(halves.left, left, depth + 1, !is_in_scratch, source);
      build(halves.right, left + 1, depth + 1, !is_in_scratch, source);
    }
    node.cost = inner_costs(range.box, range.count, nodes_[left].cost, nodes_[left + 1].cost, settings_);
  }

  /// Moves the primitives over to the other array, the left ones to its front.
  Halves split(const Range& range, int depth, bool is_in_scratch) {
    const std::span<const PrimitiveRef> from = (is_in_scratch ? scratch_ : refs_).subspan(range.first, range.count);
    const std::span<PrimitiveRef> to = (is_in_scratch ? refs_ : scratch_).subspan(range.first, range.count);
    if (depth < max_heuristic_depth) {
      const BinMapping mapping(range.centers, range.count, settings_.bins);
      Bins bins(mapping.count);
      fill(bins, from, mapping);
      BinSplit best = bins.best_split(mapping);
      if (best.cost < infinity) {
        bins.measure(best);
        Halves halves{{range.first, best.left_count, best.left, {}},
                      {range.first + best.left_count, range.count - best.left_count, best.right, {}}};
        const auto is_left = [&](const PrimitiveRef& ref) { return mapping(ref, best.axis) < best.bin; };
        partition(from, to, is_left, halves);
        return halves;
      }
    }
    // Too deep, or all centres in one place: any halves will do.
    std::copy(from.begin(), from.end(), to.begin());
    const std::uint32_t half = range.count / 2;
    return {range_of(to, range.first, 0, half), range_of(to, range.first, half, range.count)};
  }
  static Range range_of(std::span<const PrimitiveRef> refs, std::uint32_t base, std::uint32_t first,
                        std::uint32_t end) {
    Range range{base + first, end - first, {}, {}};
    for (const PrimitiveRef& ref : refs.subspan(first, end - first)) {
      range.box.add(ref.box()), range.centers.add(doubled_center(ref.box()));
    }
    return range;
  }

  static void fill(Bins& bins, std::span<const PrimitiveRef> refs, const BinMapping& mapping) {
    if (refs.size() < parallel_split_size) {
      bins.add(refs, mapping);
      return;
    }
    bins = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, refs.size(), chunk_size), bins,
        [&](const auto& part, Bins sum) {
          sum.add(refs.subspan(part.begin(), part.size()), mapping);
          return sum;
        },
        [](Bins a, const Bins& b) {
          a.add(b);
          return a;
        });
  }

  /// Left ones from `left` upwards, right ones from before `right` downwards, without a branch that the processor would
  /// mispredict every second time.
  static void move_refs(std::span<const PrimitiveRef> from, PrimitiveRef* to, std::size_t left, std::size_t right,
                        const auto& is_left, FlippedBox (&centers)[2]) {
    for (const PrimitiveRef& ref : from) {
      const bool goes_left = is_left(ref);
      to[goes_left ? left : right - 1] = ref;
      left += goes_left ? 1 : 0;
      right -= goes_left ? 0 : 1;
      centers[goes_left ? 0 : 1].add(doubled_center(ref.box()));
    }
  }

  static void partition(std::span<const PrimitiveRef> from, std::span<PrimitiveRef> to, const auto& is_left,
                        Halves& halves) {
    FlippedBox centers[2];
    if (from.size() < parallel_split_size) {
      move_refs(from, to.data(), 0, from.size(), is_left, centers);
    } else {
      struct Chunk {
        std::size_t left_count = 0, left = 0, right = 0;  // number, places to write to
        FlippedBox centers[2];
      };
      std::vector<Chunk> chunks((from.size() + chunk_size - 1) / chunk_size);
      const auto chunk_refs = [&](std::size_t i) {
        return from.subspan(i * chunk_size, std::min(chunk_size, from.size() - i * chunk_size));
      };
      tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
        std::size_t count = 0;
        for (const PrimitiveRef& ref : chunk_refs(i)) count += is_left(ref) ? 1 : 0;
        chunks[i].left_count = count;
      });
      std::size_t left = 0, right = from.size();
      for (std::size_t i = 0; i < chunks.size(); ++i) {
        chunks[i].left = left, chunks[i].right = right;
        left += chunks[i].left_count;
        right -= chunk_refs(i).size() - chunks[i].left_count;
      }
      tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
        move_refs(chunk_refs(i), to.data(), chunks[i].left, chunks[i].right, is_left, chunks[i].centers);
      });
      for (const Chunk& chunk : chunks) centers[0].add(chunk.centers[0]), centers[1].add(chunk.centers[1]);
    }
    halves.left.centers = centers[0], halves.right.centers = centers[1];
  }

  BinaryNodes& nodes_;
  std::span<PrimitiveRef> refs_, scratch_;
  const TreeSettings& settings_;
};

}  // namespace

CollapseCosts inner_costs(FlippedBox box, std::uint32_t count, const CollapseCosts& left, const CollapseCosts& right,
                          const TreeSettings& settings) {
  const auto least = [&](std::size_t children) {
    float cost = infinity;
    for (std::size_t k = 1; k < children; ++k) cost = std::min(cost, left[k - 1] + right[children - k - 1]);
    return cost;
  };
  CollapseCosts costs;
  costs[0] = std::min(leaf_cost(box, count, settings), box.half_area() + least(8));
  for (std::size_t i = 2; i <= 7; ++i) costs[i - 1] = std::min(costs[i - 2], least(i));
  return costs;
}

std::uint32_t BinaryNodes::new_chunk() {
  const std::uint32_t first = next_.fetch_add(chunk, std::memory_order_relaxed);
  std::atomic<BinaryNode*>& piece = pieces_.at(first / piece_size);
  if (!piece.load(std::memory_order_acquire)) {
    const std::lock_guard lock(growing_);
    if (!piece.load(std::memory_order_relaxed)) {
      piece.store(memory_.emplace_back(piece_size).data(), std::memory_order_release);
    }
  }
  return first;
}

void build_binary_tree(BinaryNodes& nodes, std::span<PrimitiveRef> refs, std::span<PrimitiveRef> scratch,
                       const TreeSettings& settings) {
  Builder(nodes, refs, scratch, settings).build();
}

}  // namespace candil
