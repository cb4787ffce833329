#include "metrics/map_statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "metrics/parallel_rows.h"

namespace candil {
namespace {

/// Integers in the order of the floats: NaN above infinity, -0 below 0.
std::uint32_t sortable_bits(float value) {
  if (std::isnan(value)) return ~std::uint32_t{0};
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

float value_of_bits(std::uint32_t bits) {
  return std::bit_cast<float>(bits & 0x80000000u ? bits & 0x7fffffffu : ~bits);
}

template <typename Visit>
void visit_selected(const Image& map, const PixelSelection& selection, int y, const Visit& visit) {
  const std::size_t first = static_cast<std::size_t>(y) * map.width;
  for (std::size_t i = first; i < first + static_cast<std::size_t>(map.width); ++i)
    if (selection.contains(i)) visit(map.pixels[i]);
}

/// Counts of the upper 16 bits. Whole bands of rows share a table: their sum is the same in any order.
std::vector<std::size_t> count_upper_halves(const Image& map, const PixelSelection& selection) {
  constexpr std::size_t halves = std::size_t{1} << 16;
  constexpr int band = 512;
  const int bands = (map.height + band - 1) / band;
  std::vector<std::vector<std::uint32_t>> counts(static_cast<std::size_t>(bands));
  for_each_part(bands, [&](int i) {
    std::vector<std::uint32_t>& mine = counts[static_cast<std::size_t>(i)];
    mine.resize(halves);
    for (int y = i * band; y < std::min((i + 1) * band, map.height); ++y)
      visit_selected(map, selection, y, [&](float value) { ++mine[sortable_bits(value) >> 16]; });
  });
  std::vector<std::size_t> total(halves);
  for (const auto& part : counts)
    for (std::size_t k = 0; k < halves; ++k) total[k] += part[k];
  return total;
}

}  // namespace

double map_mean(const Image& map, const PixelSelection& selection) {
  if (selection.count() == 0) return 0;
  const auto sum = sum_rows<double>(map.height, [&](int y) {
    double row = 0;
    visit_selected(map, selection, y, [&](float value) { row += value; });
    return row;
  });
  return sum / static_cast<double>(selection.count());
}

std::vector<float> map_order_statistics(const Image& map, const PixelSelection& selection,
                                        std::span<const std::size_t> ranks) {
  const std::vector<std::size_t> counts = count_upper_halves(map, selection);
  std::vector<float> values(ranks.size());
  for_each_part(static_cast<int>(ranks.size()), [&](int i) {
    std::size_t rank = ranks[static_cast<std::size_t>(i)];
    std::uint32_t upper = 0;
    while (rank >= counts[upper]) rank -= counts[upper++];
    std::vector<std::uint32_t> candidates;
    candidates.reserve(counts[upper]);
    for (int y = 0; y < map.height; ++y)
      visit_selected(map, selection, y, [&](float value) {
        const std::uint32_t bits = sortable_bits(value);
        if (bits >> 16 == upper) candidates.push_back(bits);
      });
    std::ranges::nth_element(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(rank));
    values[static_cast<std::size_t>(i)] = value_of_bits(candidates[rank]);
  });
  return values;
}

std::vector<float> map_quantiles(const Image& map, const PixelSelection& selection, std::span<const double> shares) {
  const std::size_t count = selection.count();
  if (count == 0) return std::vector<float>(shares.size(), 0.0f);
  std::vector<std::size_t> ranks;
  for (const double share : shares) {
    const auto wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(count)));
    ranks.push_back(std::clamp<std::size_t>(wanted, 1, count) - 1);
  }
  return map_order_statistics(map, selection, ranks);
}

std::vector<std::size_t> map_histogram(const Image& map, const PixelSelection& selection, float low, float high,
                                       int bins) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(bins), 0);
  const float scale = static_cast<float>(bins) / (high - low);
  for (int y = 0; y < map.height; ++y)
    visit_selected(map, selection, y, [&](float value) {
      const float place = std::isnan(value) ? static_cast<float>(bins) : (value - low) * scale;
      ++counts[static_cast<std::size_t>(std::clamp(place, 0.0f, static_cast<float>(bins - 1)))];
    });
  return counts;
}

}  // namespace candil
