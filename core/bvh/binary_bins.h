/// Binned surface area heuristic: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
#pragma once

#include <span>

#include "core/bvh/primitive_ref.h"
#include "core/simd.h"

namespace candil {

inline constexpr int max_bins = 16;

/// Which of `count` equal slices between the outermost centres a centre is in, along each axis.
struct BinMapping {
  Float4 base, scale;
  int count;

  BinMapping(FlippedBox centers, std::size_t primitives)
      // Few primitives need few bins: sweeping over them would take longer than filling them.
      : count(static_cast<int>(std::min<std::size_t>(max_bins, 4 + primitives / 4))) {
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
    Int4 bin = __builtin_convertvector(position, Int4);
    const Int4 last = Int4{} + (count - 1);
    bin = bin > last ? last : bin;
    return bin < 0 ? Int4{} : bin;
  }
  /// The same along one axis.
  int operator()(const PrimitiveRef& ref, int axis) const {
    const float* lanes = reinterpret_cast<const float*>(&ref);
    const float position = (lanes[4 + axis] - lanes[axis] - base[axis]) * scale[axis];
    return std::max(0, std::min(static_cast<int>(position), count - 1));
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
    for (int axis = 0; axis < 3; ++axis) {
      std::fill_n(boxes_[axis], count, FlippedBox());
      std::fill_n(sizes_[axis], count, 0U);
    }
  }
  void add(std::span<const PrimitiveRef> refs, const BinMapping& mapping) {
    for (const PrimitiveRef& ref : refs) {
      const BinMapping::Int4 bin = mapping(ref);
      const FlippedBox box(ref.v);  // with the id in a lane that nobody reads
      for (int axis = 0; axis < 3; ++axis) {
        boxes_[axis][bin[axis]].add(box);
        ++sizes_[axis][bin[axis]];
      }
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < count_; ++i) {
        boxes_[axis][i].add(other.boxes_[axis][i]);
        sizes_[axis][i] += other.sizes_[axis][i];
      }
    }
  }
  BinSplit best_split(const BinMapping& mapping) const {
    BinSplit best;
    for (int axis = 0; axis < 3; ++axis) {
      if (mapping.scale[axis] == 0) continue;
      float right_cost[max_bins];
      FlippedBox box;
      std::uint32_t size = 0;
      for (int i = count_ - 1; i > 0; --i) {
        box.add(boxes_[axis][i]), size += sizes_[axis][i];
        right_cost[i] = size > 0 ? static_cast<float>(size) * box.half_area() : infinity;
      }
      box = FlippedBox(), size = 0;
      for (int i = 1; i < count_; ++i) {
        box.add(boxes_[axis][i - 1]), size += sizes_[axis][i - 1];
        if (size == 0) continue;
        const float cost = static_cast<float>(size) * box.half_area() + right_cost[i];
        if (cost < best.cost) best.cost = cost, best.axis = axis, best.bin = i, best.left_count = size, best.left = box;
      }
    }
    for (int i = best.bin; i < count_ && best.cost < infinity; ++i) best.right.add(boxes_[best.axis][i]);
    return best;
  }

 private:
  int count_;
  FlippedBox boxes_[3][max_bins];
  std::uint32_t sizes_[3][max_bins];
};

}  // namespace candil
