/// Binned surface area heuristic: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#pragma once

#include <span>

#include "core/bvh/primitive_ref.h"
#include "core/simd.h"

namespace candil {

inline constexpr int max_bins = 32;

/// Which of `count` equal slices between the outermost centres a centre is in, along each axis.
struct BinMapping {
  Float4 base, scale;
  int count;

  BinMapping(FlippedBox centers, std::size_t primitives, int bins)
      // Few primitives need few bins: sweeping over them would take longer than filling them.
      : count(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(bins), 4 + primitives / 4))) {
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centers.high(axis) - centers.low(axis);
      base[axis] = centers.low(axis);
      // Slightly less than exact, for the last centre. 0 where all are in one place (or too close to be told apart).
      scale[axis] = extent > 1e-30f ? 0.99999f * static_cast<float>(count) / extent : 0.0f;
    }
    base[3] = scale[3] = 0;
  }
  using Int4 = int __attribute__((vector_size(16)));
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
    for (int axis = 0; axis < 3; ++axis) std::fill_n(boxes_[axis], count, FlippedBox());
    std::memset(sizes_, 0, static_cast<std::size_t>(count) * sizeof sizes_[0]);
  }
  void add(std::span<const PrimitiveRef> refs, const BinMapping& mapping) {
    for (const PrimitiveRef& ref : refs) {
      const BinMapping::Int4 bin = mapping(ref);
      const FlippedBox box(ref.v);  // with the id in a lane that nobody reads
      for (int axis = 0; axis < 3; ++axis) {
        boxes_[axis][bin[axis]].add(box);
        ++sizes_[bin[axis]][axis];
      }
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < count_; ++i) {
        boxes_[axis][i].add(other.boxes_[axis][i]);
        sizes_[i][axis] += other.sizes_[i][axis];
      }
    }
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
      if (i < split.bin) split.left_count += sizes_[i][split.axis];
      (i < split.bin ? split.left : split.right).add(boxes_[split.axis][i]);
    }
  }

 private:
  using Int4 = BinMapping::Int4;
  Float4 sizes(int bin) const {
    Int4 v;
    std::memcpy(&v, sizes_[bin], sizeof v);
    return __builtin_convertvector(v, Float4);
  }
  static Float4 extent(FlippedBox box) {
    return __builtin_shufflevector(box.v, box.v, 0, 1, 2, 3) + __builtin_shufflevector(box.v, box.v, 4, 5, 6, 7);
  }
  static Float4 half_areas(FlippedBox a, FlippedBox b, FlippedBox c) {
    const auto [x, y, z] = from_rows(extent(a), extent(b), extent(c));
    return x * (y + z) + y * z;
  }
  int count_;
  FlippedBox boxes_[3][max_bins];
  alignas(16) std::uint32_t sizes_[max_bins][4];  // lane 3 is not used
};

}  // namespace candil
