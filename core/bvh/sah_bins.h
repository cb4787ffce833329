/// What core/bvh/binned_build.cpp sorts, and the bins that it chooses splits by.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "core/bvh/binned_build.h"

namespace candil::sah {

inline constexpr std::uint32_t max_bins = 64;
struct Box {
  Float4 low = splat(infinity), high = splat(-infinity);

  void add(const Box& other) {
    low = low < other.low ? low : other.low;
    high = high > other.high ? high : other.high;
  }
  Float4 extent() const { return high - low; }
  /// Half of the surface; 0 if empty.
  float area() const {
    const Float4 e = high > low ? high - low : splat(0);
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
  Bounds bounds() const { return {to_vec3(low), to_vec3(high)}; }
};

/// A box and, in its unused lanes, whose it is.
struct Item {
  Float4 low, high;
  Box box() const { return {low, high}; }
  /// Twice the centre; comparisons need no more.
  Float4 center() const { return low + high; }
  std::uint32_t id() const { return std::bit_cast<std::uint32_t>(static_cast<float>(low[3])); }
};

/// Items [begin, end) with the box of them and of their centres.
struct Range {
  std::size_t begin = 0, end = 0;
  Box box, centers;

  std::size_t size() const { return end - begin; }
  void add(const Item& item) {
    box.add(item.box());
    centers.add({item.center(), item.center()});
  }
  void add(const Range& other) { box.add(other.box), centers.add(other.centers); }
};

/// Of a leaf, in units of visiting a pair of nodes.
inline float leaf_cost(std::size_t items, const BinnedBuildOptions& options) {
  const auto leaves = (items + options.max_leaf - 1) / options.max_leaf;
  return options.leaf_cost * static_cast<float>(leaves);
}

/// Where to cut a range: items up to that bin go left.
struct Split {
  int axis = -1;  // none
  std::uint32_t bin = 0;
  float cost = infinity;
};

/// Maps centres to bins.
struct Binning {
  Float4 low, scale;
  std::uint32_t count;

  Binning(const Box& centers, std::uint32_t bins) : low(centers.low), scale(splat(0)), count(bins) {
    const Float4 extent = centers.extent();
    for (int axis = 0; axis < 3; ++axis) {
      const float s = 0.9999f * static_cast<float>(bins) / extent[axis];
      if (extent[axis] > 0 && s < infinity) scale[axis] = s;
    }
  }
  using Int4 = std::int32_t __attribute__((vector_size(16)));
  /// Per axis; lane 3 is not used.
  Int4 bins_of(const Item& item) const { return __builtin_convertvector((item.center() - low) * scale, Int4); }
  std::uint32_t bin_of(const Item& item, int axis) const { return static_cast<std::uint32_t>(bins_of(item)[axis]); }
  bool is_flat(int axis) const { return scale[axis] == 0; }
};

class Bins {
 public:
  explicit Bins(std::uint32_t count) : count_(count) {
    for (auto& axis : bins_) std::fill_n(axis.begin(), count, Bin{});
  }
  void add(const Item& item, const Binning& binning) {
    const auto bins = binning.bins_of(item);
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = bins_[axis][static_cast<std::size_t>(bins[axis])];
      bin.box.add(item.box());
      ++bin.items;
    }
  }
  void add(const Bins& other) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::uint32_t i = 0; i < count_; ++i) {
        bins_[axis][i].box.add(other.bins_[axis][i].box);
        bins_[axis][i].items += other.bins_[axis][i].items;
      }
    }
  }
  /// The split of the least cost, which is the sum of area times leaf cost over both sides.
  Split best(const Binning& binning, const BinnedBuildOptions& options) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (binning.is_flat(axis)) continue;
      std::array<float, max_bins> right_costs;
      Box box;
      std::uint32_t items = 0;
      for (std::uint32_t i = count_ - 1; i > 0; --i) {
        box.add(bins_[axis][i].box), items += bins_[axis][i].items;
        right_costs[i - 1] = items == 0 ? infinity : box.area() * leaf_cost(items, options);
      }
      box = {}, items = 0;
      for (std::uint32_t i = 0; i + 1 < count_; ++i) {
        box.add(bins_[axis][i].box), items += bins_[axis][i].items;
        if (items == 0) continue;
        const float cost = box.area() * leaf_cost(items, options) + right_costs[i];
        if (cost < best.cost) best = {axis, i, cost};
      }
    }
    return best;
  }

 private:
  struct Bin {
    Box box;
    std::uint32_t items = 0;
  };
  std::uint32_t count_;
  std::array<std::array<Bin, max_bins>, 3> bins_;
};

}  // namespace candil::sah
