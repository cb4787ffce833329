#include "metrics/map_statistics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

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
  if (selection.is_everything()) {
    for (std::size_t i = first; i < first + static_cast<std::size_t>(map.width); ++i) visit(map.pixels[i]);
    return;
  }
  for (std::size_t i = first; i < first + static_cast<std::size_t>(map.width); ++i)
    if (selection.contains(i)) visit(map.pixels[i]);
}

constexpr std::size_t halves = std::size_t{1} << 16;

/// A table of `size` counts, added up over all pixels: `count` adds those of a value to it. Whole bands of rows share a
/// table: their sum is the same in any order.
template <typename Count>
std::vector<std::size_t> count_values(const Image& map, const PixelSelection& selection, std::size_t size,
                                      const Count& count) {
  constexpr int band = 360;
  const int bands = (map.height + band - 1) / band;
  std::vector<std::vector<std::uint32_t>> counts(static_cast<std::size_t>(bands));
  for_each_part(bands, [&](int i) {
    std::vector<std::uint32_t>& mine = counts[static_cast<std::size_t>(i)];
    mine.resize(size);
    for (int y = i * band; y < std::min((i + 1) * band, map.height); ++y)
      visit_selected(map, selection, y, [&](float value) { count(sortable_bits(value), mine.data()); });
  });
  std::vector<std::size_t> total(size);
  for (const auto& part : counts)
    for (std::size_t k = 0; k < size; ++k) total[k] += part[k];
  return total;
}

/// The entry that holds this place of the sorted list, which becomes the place among those of the entry.
std::size_t find_rank(std::span<const std::size_t> counts, std::size_t& rank) {
  std::size_t entry = 0;
  while (rank >= counts[entry]) rank -= counts[entry++];
  return entry;
}

/// Tables are 64 K counts: some ranks at a time.
constexpr std::size_t most_ranks = 16;

std::vector<float> some_order_statistics(const Image& map, const PixelSelection& selection,
                                         std::span<const std::size_t> ranks) {
  // First by the upper 16 bits of values, then by the lower ones of those that have the upper ones of an answer.
  const std::vector<std::size_t> uppers =
      count_values(map, selection, halves, [](std::uint32_t bits, std::uint32_t* counts) { ++counts[bits >> 16]; });
  std::vector<std::size_t> rests(ranks.begin(), ranks.end()), answers, tables;
  constexpr std::uint8_t no_table = most_ranks;
  std::vector<std::uint8_t> table_of(halves, no_table);
  for (std::size_t& rest : rests) {
    answers.push_back(find_rank(uppers, rest));
    std::uint8_t& table = table_of[answers.back()];
    if (table == no_table) table = static_cast<std::uint8_t>(tables.size()), tables.push_back(answers.back());
  }
  const std::vector<std::size_t> lowers =
      count_values(map, selection, halves * tables.size(), [&](std::uint32_t bits, std::uint32_t* counts) {
        const std::size_t table = table_of[bits >> 16];
        if (table != no_table) ++counts[table * halves + (bits & 0xffffu)];
      });
  std::vector<float> values;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const std::span table = std::span(lowers).subspan(table_of[answers[i]] * halves, halves);
    const std::size_t lower = find_rank(table, rests[i]);
    values.push_back(value_of_bits(static_cast<std::uint32_t>(answers[i] << 16 | lower)));
  }
  return values;
}

}  // namespace

double map_mean(const Image& map, const PixelSelection& selection) {
  if (selection.count() == 0) return 0;
  const auto sum = sum_rows<double>(map.height, [&](int y) {
    // Sums that do not wait for each other.
    std::array<double, 8> rows{};
    std::size_t i = 0;
    visit_selected(map, selection, y, [&](float value) { rows[i++ % rows.size()] += value; });
    return std::accumulate(rows.begin(), rows.end(), 0.0);
  });
  return sum / static_cast<double>(selection.count());
}

std::vector<float> map_order_statistics(const Image& map, const PixelSelection& selection,
                                        std::span<const std::size_t> ranks) {
  std::vector<float> values;
  for (std::size_t i = 0; i < ranks.size(); i += most_ranks) {
    const std::span some = ranks.subspan(i, std::min(most_ranks, ranks.size() - i));
    for (const float value : some_order_statistics(map, selection, some)) values.push_back(value);
  }
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
