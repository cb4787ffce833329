/// Means, exact quantiles and histograms of maps.
#include "metrics/map_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace candil::test {
namespace {

Image random_map(int width, int height) {
  Image map(width, height, 1);
  std::uint32_t state = 1;
  for (float& value : map.pixels) {
    state = state * 1664525u + 1013904223u;
    value = static_cast<float>(static_cast<int>(state >> 8) - (1 << 23)) / 1e6f;  // both signs
  }
  return map;
}

// Nearest rank: of 1000 values, the share s is the one at place ceil(1000 s), counted from 1.
TEST(MapStatistics, QuantilesAreThoseOfTheSortedList) {
  const Image map = random_map(50, 20);
  std::vector<float> sorted = map.pixels;
  std::ranges::sort(sorted);
  const std::vector<double> shares = {0, 0.0005, 0.25, 0.5, 0.9, 0.999, 1};
  EXPECT_EQ(
      map_quantiles(map, PixelSelection(50, 20), shares),
      (std::vector<float>{sorted[0], sorted[0], sorted[249], sorted[499], sorted[899], sorted[998], sorted[999]}));
}

// More at a time than there are tables for, in any order, and twice the same.
TEST(MapStatistics, ManyRanksAtATime) {
  const Image map = random_map(50, 20);
  std::vector<float> sorted = map.pixels;
  std::ranges::sort(sorted);
  std::vector<std::size_t> ranks;
  std::vector<float> wanted;
  for (std::size_t i = 0; i < 50; ++i) ranks.push_back(i * 377 % 1000), ranks.push_back(i * 377 % 1000);
  for (const std::size_t rank : ranks) wanted.push_back(sorted[rank]);
  EXPECT_EQ(map_order_statistics(map, PixelSelection(50, 20), ranks), wanted);
}

TEST(MapStatistics, QuantilesOfTiesAndOfASelection) {
  Image map(4, 1, 1);
  map.pixels = {2, 1, 2, 7};
  PixelSelection selection(4, 1);
  EXPECT_EQ(map_quantiles(map, selection, std::vector<double>{0.5, 0.75, 0.76}), (std::vector<float>{2, 2, 7}));
  selection.keep(std::vector<Region>{{0, 0, 2, 1}});
  EXPECT_EQ(map_quantiles(map, selection, std::vector<double>{0.5, 1}), (std::vector<float>{1, 2}));
  EXPECT_EQ(map_mean(map, selection), 1.5);
}

TEST(MapStatistics, NaNIsWorseThanAnything) {
  Image map(3, 1, 1);
  map.pixels = {std::nanf(""), infinity, 1};
  const std::vector<float> quantiles = map_quantiles(map, PixelSelection(3, 1), std::vector<double>{0.1, 0.6, 1});
  EXPECT_EQ(quantiles[0], 1);
  EXPECT_EQ(quantiles[1], infinity);
  EXPECT_TRUE(std::isnan(quantiles[2]));
  EXPECT_TRUE(std::isnan(map_mean(map, PixelSelection(3, 1))));
  EXPECT_EQ(map_histogram(map, PixelSelection(3, 1), 0, 2, 4), (std::vector<std::size_t>{0, 0, 1, 2}));
}

TEST(MapStatistics, OfNoPixels) {
  PixelSelection nothing(2, 2);
  nothing.keep(Image(2, 2, 1));
  EXPECT_EQ(nothing.count(), 0u);
  EXPECT_EQ(map_mean(Image(2, 2, 1), nothing), 0);
  EXPECT_EQ(map_quantiles(Image(2, 2, 1), nothing, std::vector<double>{0.5}), std::vector<float>{0});
}

TEST(MapStatistics, HistogramHasEveryPixelOnce) {
  Image map(5, 1, 1);
  map.pixels = {-1, 0, 0.49f, 0.5f, 3};
  EXPECT_EQ(map_histogram(map, PixelSelection(5, 1), 0, 1, 2), (std::vector<std::size_t>{3, 2}));
}

}  // namespace
}  // namespace candil::test
