/// Discrete and piecewise constant distributions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math.h"

namespace candil {

/// Piecewise constant density over [0, 1)^2 given by a grid of non-negative weights (Pharr, Jakob and Humphreys 2023,
/// appendix A.5.2). A grid whose weights are all zero becomes the uniform density.
class Distribution2D {
 public:
  Distribution2D() = default;
  /// `weights` in rows of `width`, `height` rows; width, height >= 1, or both 0 for an empty distribution.
  Distribution2D(std::span<const float> weights, int width, int height);

  bool is_empty() const { return width_ == 0; }
  struct Sample {
    Vec2 point;  ///< x along the width, y along the height.
    float pdf;   ///< With respect to area in the unit square.
  };
  Sample sample(Vec2 u) const;
  float pdf(Vec2 point) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> row_cdfs_;    // height x (width + 1), each from 0 to 1
  std::vector<float> column_cdf_;  // height + 1
};

/// Draws an index with probability proportional to its weight in constant time (Walker 1974; built as in Vose 1991).
class AliasTable {
 public:
  AliasTable() = default;
  /// Non-negative, finite weights. If all are zero, the choice is uniform.
  explicit AliasTable(std::span<const float> weights);

  std::size_t size() const { return cells_.size(); }
  struct Sample {
    std::uint32_t index;
    float probability;
  };
  /// u in [0, 1); its digits choose the cell first and then decide within it, so that a large table wants many. Not to
  /// be called on an empty table.
  Sample sample(double u) const {
    const double position = u * count_;
    const auto index = static_cast<std::uint32_t>(std::min(static_cast<std::int64_t>(position), last_));
    const Cell& cell = cells_[index];
    const std::uint32_t chosen = position - index < cell.threshold ? index : cell.alias;
    return {chosen, cells_[chosen].probability};
  }
  float probability(std::uint32_t index) const { return cells_[index].probability; }

 private:
  struct Cell {
    float threshold;  // of choosing the cell itself
    std::uint32_t alias;
    float probability;
  };
  std::vector<Cell> cells_;
  double count_ = 0;        // of cells_
  std::int64_t last_ = -1;  // of their indices
};

}  // namespace candil
