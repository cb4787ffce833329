#include "core/distribution.h"

#include <gtest/gtest.h>

#include <array>

namespace candil {
namespace {

// 5 x 4 cells with an empty row, empty cells at both ends of a row, and weights a factor of 10^5 apart.
constexpr int width = 5, height = 4;
constexpr std::array<float, 20> weights = {0,     1,   2, 3, 0,  //
                                           0,     0,   0, 0, 0,  //
                                           5,     0,   0, 0, 1,  //
                                           1e-3f, 100, 1, 0, 0};
constexpr float sum = 113.001f;

Vec2 cell_center(int x, int y) {
  return {(static_cast<float>(x) + 0.5f) / width, (static_cast<float>(y) + 0.5f) / height};
}

TEST(Distribution2D, DensityIsTheWeightOverTheMeanWeight) {
  const Distribution2D distribution(weights, width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float expected = weights[y * width + x] * width * height / sum;
      // Densities are differences of a cumulative float table: absolute error of a rounding or two, times 20 cells.
      EXPECT_NEAR(distribution.pdf(cell_center(x, y)), expected, 1e-5f) << x << ", " << y;
    }
  }
}

TEST(Distribution2D, SampleReportsTheDensityOfItsPoint) {
  const Distribution2D distribution(weights, width, height);
  constexpr int n = 300;
  for (int i = 0; i < n * n; ++i) {
    const auto sample =
        distribution.sample({(static_cast<float>(i % n) + 0.5f) / n, (static_cast<float>(i / n) + 0.5f) / n});
    ASSERT_GT(sample.pdf, 0);
    // A point within rounding of a border may be looked up on its other side.
    const Vec2 in_cells = sample.point * Vec2(width, height), from_border = glm::abs(in_cells - glm::round(in_cells));
    if (glm::min(from_border.x, from_border.y) < 1e-5f) continue;
    ASSERT_FLOAT_EQ(sample.pdf, distribution.pdf(sample.point)) << sample.point.x << ", " << sample.point.y;
  }
}

TEST(Distribution2D, FrequenciesFollowTheWeights) {
  // Midpoints of a fine grid of random numbers: each cell's share is exact but for the numbers at its borders.
  const Distribution2D distribution(weights, width, height);
  constexpr int n = 2000;
  std::array<double, 20> share{};
  for (int i = 0; i < n * n; ++i) {
    const Vec2 p =
        distribution.sample({(static_cast<float>(i % n) + 0.5f) / n, (static_cast<float>(i / n) + 0.5f) / n}).point;
    share[static_cast<int>(p.y * height) * width + static_cast<int>(p.x * width)] += 1.0 / (n * n);
  }
  for (int i = 0; i < width * height; ++i) EXPECT_NEAR(share[i], weights[i] / sum, 2.0 / n) << i;
}

TEST(Distribution2D, ExtremeNumbersNeverChooseEmptyCells) {
  const Distribution2D distribution(weights, width, height);
  for (const float x : {0.0f, one_minus_epsilon}) {
    for (const float y : {0.0f, one_minus_epsilon}) {
      const auto sample = distribution.sample({x, y});
      EXPECT_GT(sample.pdf, 0);
      EXPECT_TRUE(sample.point.x >= 0 && sample.point.x < 1 && sample.point.y >= 0 && sample.point.y < 1);
    }
  }
}

TEST(Distribution2D, AllBlackBecomesUniform) {
  const std::array<float, 6> black{};
  const Distribution2D distribution(black, 3, 2);
  const auto sample = distribution.sample({0.3f, 0.9f});
  EXPECT_NEAR(sample.pdf, 1, 1e-6f);
  EXPECT_NEAR(sample.point.x, 0.3f, 1e-6f);
  EXPECT_NEAR(sample.point.y, 0.9f, 1e-6f);
  EXPECT_TRUE(Distribution2D().is_empty());
}

void expect_frequencies(const std::vector<float>& table_weights, const std::vector<double>& expected) {
  const AliasTable table(table_weights);
  ASSERT_EQ(table.size(), expected.size());
  constexpr int n = 1 << 18;
  std::vector<double> share(expected.size());
  for (int i = 0; i < n; ++i) {
    const auto sample = table.sample((static_cast<float>(i) + 0.5f) / n);
    share[sample.index] += 1.0 / n;
    ASSERT_EQ(sample.probability, table.probability(sample.index));
    ASSERT_GT(sample.probability, 0);
  }
  // The table cuts [0, 1) into at most two intervals a cell; counting midpoints errs by at most one at each.
  const double tolerance = 2.0 * static_cast<double>(expected.size()) / n + 1e-6;
  double total = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(share[i], expected[i], tolerance) << i;
    EXPECT_NEAR(table.probability(static_cast<std::uint32_t>(i)), expected[i], 1e-6) << i;
    total += table.probability(static_cast<std::uint32_t>(i));
  }
  EXPECT_NEAR(total, 1, 1e-5);
}

TEST(AliasTable, FrequenciesFollowTheWeights) {
  expect_frequencies({7}, {1});
  expect_frequencies({1, 3}, {0.25, 0.75});
  expect_frequencies({0, 2, 0, 6, 0}, {0, 0.25, 0, 0.75, 0});
  expect_frequencies({0, 0, 0}, {1.0 / 3, 1.0 / 3, 1.0 / 3});
  expect_frequencies({1e-30f, 1e30f}, {0, 1});
}

TEST(AliasTable, ManyUnevenWeights) {
  std::vector<float> many;
  double total = 0;
  for (int i = 0; i < 1000; ++i) many.push_back(i % 7 == 0 ? 0.0f : static_cast<float>(1 + (i * 7919) % 1009));
  for (const float w : many) total += w;
  std::vector<double> expected;
  for (const float w : many) expected.push_back(w / total);
  expect_frequencies(many, expected);
}

TEST(AliasTable, ExtremeNumbersAreInRange) {
  const AliasTable table(std::array{0.0f, 1.0f, 2.0f, 0.0f});
  for (const float u : {0.0f, 0.25f, 0.5f, one_minus_epsilon}) EXPECT_GT(table.sample(u).probability, 0) << u;
}

// A million cells take 20 bits of the number for the choice of the cell; the coin within needs as many again. Cells of
// weight 3 and 1 in turn: of the numbers that fall into the cells of weight 1 (half of the table), half must stay
// there.
TEST(AliasTable, LargeTablesAreFairToo) {
  constexpr std::uint32_t count = 1 << 20;
  std::vector<float> uneven(count);
  for (std::uint32_t i = 0; i < count; ++i) uneven[i] = i % 2 == 0 ? 3.0f : 1.0f + 1e-3f * static_cast<float>(i % 7);
  const AliasTable table(uneven);
  // Sweep one cell evenly: the share that stays is its probability times the number of cells.
  for (const std::uint32_t cell : {1U, 77777U, count - 1}) {
    constexpr int steps = 4096;
    int stayed = 0;
    for (int i = 0; i < steps; ++i) stayed += table.sample((cell + (i + 0.5) / steps) / count).index == cell;
    EXPECT_NEAR(static_cast<double>(stayed) / steps, table.probability(cell) * count, 1.0 / steps) << cell;
  }
}

}  // namespace
}  // namespace candil
