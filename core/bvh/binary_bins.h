/// Binned surface area heuristic: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#pragma once

#include <span>

#include "core/bvh/primitive_ref.h"
#include "core/simd.h"

namespace candil {

inline constexpr int max_bins = 32;

/// Which of `count` equal slices between the outermost centres a centre is in, along each axis.
struct BinMapping {
  using Int4 = int __attribute__((vector_size(16)));

  Float4 base, scale;
  int count;

  BinMapping(FlippedBox centers, std::size_t primitives, int bins)
      // Few primitives need few bins: sweeping over them would take longer than filling them.
      : count(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(bins), 4 + primitives / 4))) {
    const Float4 low = __builtin_shufflevector(centers.v, centers.v, 0, 1, 2, 3),
                 high = __builtin_shufflevector(centers.v, centers.v, 4, 5, 6, 7);
    const Int4 axes = {-1, -1, -1, 0};
    const Float4 extent = high + low;
    // Slightly less than exact, for the last centre. 0 where all are in one place (or too close to be told apart).
    const Float4 exact = splat(0.99999f * static_cast<float>(count)) / extent;
    base = std::bit_cast<Float4>(std::bit_cast<Int4>(-low) & axes);
    scale = std::bit_cast<Float4>(std::bit_cast<Int4>(exact) & (extent > 1e-30f) & axes);
  }
  Int4 operator()(const PrimitiveRef& ref) const {
    const Float8 center = doubled_center(ref.box()).v;
    const Float4 position = (__builtin_shufflevector(center, center, 4, 5, 6, 7) - base) * scale;
    const Float4 last = splat(static_cast<float>(count - 1));
    const Float4 above = position > 0 ? position : splat(0);  // also what is not a number
    return __builtin_convertvector(above < last ? above : last, Int4);
  }
  /// The same along one axis.
  int operator()(const PrimitiveRef& ref, int axis) const {
    const float* lanes = reinterpret_cast<const float*>(&ref);
    const float position = (lanes[4 + axis] - lanes[axis] - base[axis]) * scale[axis];
    const float last = static_cast<float>(count - 1), above = position > 0 ? position : 0;
    return static_cast<int>(above < last ? above : last);
  }
};

/// Primitives with a centre in a bin below `bin` go left.
struct BinSplit {
  float cost = infinity;  ///< Sum over both sides of number times half area; infinity: all centres are in one place.
  int axis = 0, bin = 0;
  std::uint32_t left_count = 0;
  FlippedBox left, right;
};

class Bins {
 public:
  explicit Bins(int count) : count_(count) {
    for (int i = 0; i < count; ++i) {
      for (FlippedBox(&boxes)[max_bins] : boxes_) boxes[i] = FlippedBox();
      sizes_[i] = Int4{};
    }
  }
  /// Neighbours in the list are often neighbours in space, and a bin can take the next primitive only when it has
  /// stored the last one. Many primitives are dealt out to several sets of bins, so that none has to wait: that is
  /// three times as fast.
  void add(std::span<const PrimitiveRef> refs, const BinMapping& mapping) {
    std::size_t i = 0;
    if (refs.size() >= 512) {
      Bins others[3] = {Bins(count_), Bins(count_), Bins(count_)};
      for (; i + 4 <= refs.size(); i += 4) {
        add(refs[i], mapping);
        for (std::size_t k = 0; k < 3; ++k) others[k].add(refs[i + k + 1], mapping);
      }
      for (const Bins& other : others) add(other);
    }
    for (; i < refs.size(); ++i) add(refs[i], mapping);
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < count_; ++i) {
        boxes_[axis][i].add(other.boxes_[axis][i]);
      }
    }
    for (int i = 0; i < count_; ++i) sizes_[i] += other.sizes_[i];
  }
  /// Sweeps over all axes at once: lane `axis` of each vector.
  BinSplit best_split(const BinMapping& mapping) const {
    Float4 right_cost[max_bins];
    FlippedBox x, y, z;  // joined boxes of the bins along each axis
    Float4 size = splat(0);
    for (int i = count_ - 1; i > 0; --i) {
      x.add(boxes_[0][i]), y.add(boxes_[1][i]), z.add(boxes_[2][i]);
      size += sizes(i);
      right_cost[i] = size * half_areas(x, y, z);  // infinity times 0, not a number, where the right side is empty
    }
    Float4 least = splat(infinity), least_bin = splat(0);
    x = y = z = FlippedBox(), size = splat(0);
    for (int i = 1; i < count_; ++i) {
      x.add(boxes_[0][i - 1]), y.add(boxes_[1][i - 1]), z.add(boxes_[2][i - 1]);
      size += sizes(i - 1);
      const Float4 cost = size * half_areas(x, y, z) + right_cost[i];
      const auto is_less = cost < least;  // never for what is not a number
      least = is_less ? cost : least;
      least_bin = is_less ? splat(static_cast<float>(i)) : least_bin;
    }
    BinSplit best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(least[axis] < best.cost) || mapping.scale[axis] == 0) continue;
      best.cost = least[axis], best.axis = axis;
      best.bin = static_cast<int>(least_bin[axis]);
    }
    return best;
  }
  /// Fills in what best_split() leaves out: the boxes of both sides and the number of the left one.
  void measure(BinSplit& split) const {
    split.left_count = 0;
    for (int i = 0; i < count_; ++i) {
      if (i < split.bin) split.left_count += static_cast<std::uint32_t>(sizes_[i][split.axis]);
      (i < split.bin ? split.left : split.right).add(boxes_[split.axis][i]);
    }
  }

 private:
  using Int4 = BinMapping::Int4;
  void add(const PrimitiveRef& ref, const BinMapping& mapping) {
    const FlippedBox box(ref.v);  // with the id in a lane that nobody reads
    const Int4 quadruple =
        mapping(ref) << 2;  // times 8 or 4, which addresses can do, it is the place of a bin in bytes
    char* const boxes = reinterpret_cast<char*>(boxes_);
    char* const sizes = reinterpret_cast<char*>(sizes_);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const std::size_t place = static_cast<std::uint32_t>(quadruple[axis]);
      reinterpret_cast<FlippedBox*>(boxes + axis * sizeof boxes_[0] + 8 * place)->add(box);
      ++reinterpret_cast<std::int32_t*>(sizes + 4 * place)[axis];
    }
  }
  Float4 sizes(int bin) const { return __builtin_convertvector(sizes_[bin], Float4); }
  static Float4 extent(FlippedBox box) {
    return __builtin_shufflevector(box.v, box.v, 0, 1, 2, 3) + __builtin_shufflevector(box.v, box.v, 4, 5, 6, 7);
  }
  static Float4 half_areas(FlippedBox a, FlippedBox b, FlippedBox c) {
    const auto [x, y, z] = from_rows(extent(a), extent(b), extent(c));
    return x * (y + z) + y * z;
  }
  int count_;
  FlippedBox boxes_[3][max_bins];
  Int4 sizes_[max_bins];  // along each axis; lane 3 is not used
};

}  // namespace candil
