#include "core/distribution.h"

#include <algorithm>
#include <cassert>

namespace candil {
namespace {

/// Fills cdf (one longer than weights) and returns the sum of the weights. Sums in double: rows may be long.
double fill_cdf(std::span<const double> weights, std::span<float> cdf) {
  double sum = 0;
  for (const double w : weights) sum += w;
  double running = 0;
  cdf[0] = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    running += sum > 0 ? weights[i] / sum : 1.0 / static_cast<double>(weights.size());
    cdf[i + 1] = static_cast<float>(running);
  }
  cdf[weights.size()] = 1;
  return sum;
}

struct Segment {
  int index;
  float position;  // within [0, 1) of the whole
  float density;
};

Segment sample_cdf(std::span<const float> cdf, float u) {
  const int count = static_cast<int>(cdf.size()) - 1;
  const auto above = std::upper_bound(cdf.begin(), cdf.end() - 1, u);
  int index = std::clamp(static_cast<int>(above - cdf.begin()) - 1, 0, count - 1);
  const float mass = cdf[index + 1] - cdf[index];
  const float within = mass > 0 ? glm::min((u - cdf[index]) / mass, one_minus_epsilon) : 0.5f;
  const float width = 1.0f / static_cast<float>(count);
  return {index, glm::min((static_cast<float>(index) + within) * width, one_minus_epsilon),
          mass * static_cast<float>(count)};
}

}  // namespace

Distribution2D::Distribution2D(std::span<const float> weights, int width, int height)
    : width_(width),
      height_(height),
      row_cdfs_(static_cast<std::size_t>(height) * (width + 1)),
      column_cdf_(static_cast<std::size_t>(height) + (height > 0)) {
  if (is_empty()) return;
  assert(weights.size() == static_cast<std::size_t>(width) * height);
  std::vector<double> row(width), row_sums(height);
  for (int y = 0; y < height; ++y) {
    const auto source = weights.subspan(static_cast<std::size_t>(y) * width, width);
    std::copy(source.begin(), source.end(), row.begin());
    row_sums[y] = fill_cdf(row, std::span(row_cdfs_).subspan(static_cast<std::size_t>(y) * (width + 1), width + 1));
  }
  fill_cdf(row_sums, column_cdf_);
}

Distribution2D::Sample Distribution2D::sample(Vec2 u) const {
  const Segment row = sample_cdf(column_cdf_, u.y);
  const auto cdf = std::span(row_cdfs_).subspan(static_cast<std::size_t>(row.index) * (width_ + 1), width_ + 1);
  const Segment column = sample_cdf(cdf, u.x);
  return {{column.position, row.position}, row.density * column.density};
}

float Distribution2D::pdf(Vec2 point) const {
  const int x = std::clamp(static_cast<int>(point.x * static_cast<float>(width_)), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(point.y * static_cast<float>(height_)), 0, height_ - 1);
  const float* row = &row_cdfs_[static_cast<std::size_t>(y) * (width_ + 1)];
  return (column_cdf_[y + 1] - column_cdf_[y]) * static_cast<float>(height_) * (row[x + 1] - row[x]) *
         static_cast<float>(width_);
}

AliasTable::AliasTable(std::span<const float> weights)
    : cells_(weights.size()),
      count_(static_cast<double>(weights.size())),
      last_(static_cast<std::int64_t>(weights.size()) - 1) {
  const auto count = static_cast<double>(weights.size());
  double sum = 0;
  for (const float w : weights) sum += w;
  std::vector<double> scaled(weights.size());
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    const double probability = sum > 0 ? weights[i] / sum : 1 / count;
    scaled[i] = probability * count;
    cells_[i] = {1, i, static_cast<float>(probability)};
    (scaled[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t under = small.back(), over = large.back();
    small.pop_back();
    cells_[under].threshold = static_cast<float>(scaled[under]);
    cells_[under].alias = over;
    scaled[over] -= 1 - scaled[under];
    if (scaled[over] < 1) {
      large.pop_back();
      small.push_back(over);
    }
  }
  // What is left on either list has a scaled weight of one up to rounding, except true zeros.
  for (const std::uint32_t i : small) {
    if (cells_[i].probability > 0 || large.empty()) continue;
    cells_[i] = {0, large.back(), 0};
  }
}

}  // namespace candil
