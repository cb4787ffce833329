/// Names, summaries and judgements.
#include "metrics/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "metrics/color_map.h"

namespace candil::test {
namespace {

/// A and B: 20 x 20 grey, one pixel of B brighter by 0.25.
struct Pair {
  Image a = Image(20, 20, 3), b = Image(20, 20, 3);
  Pair() {
    std::ranges::fill(a.pixels, 0.5f);
    b = a;
    b.pixel(10, 10)[1] = 0.75f;
  }
  Comparison compare(ValueKind kind) const { return compare_images({a, b, kind}, PixelSelection(20, 20)); }
};

bool is_met(const Comparison& comparison, const Measure& measure, double limit) {
  return judge(comparison, {{measure, limit}}).front().is_met;
}

TEST(Comparison, NamesGoBothWays) {
  for (const Metric metric : all_metrics()) EXPECT_EQ(metric_from_name(metric_name(metric)), metric);
  EXPECT_EQ(metric_from_name("fllp"), std::nullopt);
  EXPECT_EQ(measure_name({Metric::flip}), "flip");
  EXPECT_EQ(measure_name({Metric::flip, 0.99}), "flip:p99");
  EXPECT_EQ(measure_name({Metric::flip, 0.999}), "flip:p99.9");
  EXPECT_EQ(measure_name({Metric::error, 1}), "error:max");
  EXPECT_EQ(measure_name({Metric::ssim, 0}), "ssim:min");
}

TEST(Comparison, SummaryHasEveryMetricThereIs) {
  const auto metrics = [](const Comparison& comparison) {
    std::set<Metric> found;
    for (const Measurement& measurement : summarize(comparison)) found.insert(measurement.measure.metric);
    return found;
  };
  const Pair pair;
  const std::set<Metric> display = metrics(pair.compare(ValueKind::display));
  EXPECT_EQ(display.size(), all_metrics().size() - 1);
  EXPECT_FALSE(display.contains(Metric::ztest));
  const std::set<Metric> data = metrics(pair.compare(ValueKind::data));
  EXPECT_FALSE(data.contains(Metric::flip) || data.contains(Metric::ssim));
  EXPECT_TRUE(data.contains(Metric::max));
}

TEST(Comparison, ThresholdsAreMetUpToTheirLimit) {
  const Comparison comparison = Pair().compare(ValueKind::display);
  EXPECT_TRUE(is_met(comparison, {Metric::exact}, 1));
  EXPECT_FALSE(is_met(comparison, {Metric::exact}, 0));
  EXPECT_TRUE(is_met(comparison, {Metric::max}, 0.25));
  EXPECT_FALSE(is_met(comparison, {Metric::max}, 0.2499));
  EXPECT_TRUE(is_met(comparison, {Metric::error, 0.99}, 0));
  EXPECT_FALSE(is_met(comparison, {Metric::error, 1}, 0));
  EXPECT_FALSE(is_met(comparison, {Metric::flip, 1}, 0.01));
  EXPECT_TRUE(is_met(comparison, {Metric::flip, 0.5}, 0.01));
  // Better when larger. MSE is 0.0625 / 1200: 42.8 dB.
  EXPECT_TRUE(is_met(comparison, {Metric::psnr}, 42.8));
  EXPECT_FALSE(is_met(comparison, {Metric::psnr}, 42.9));
  EXPECT_FALSE(is_met(comparison, {Metric::ssim}, 1));
  EXPECT_TRUE(is_met(comparison, {Metric::ssim, 0.0}, -1));
}

TEST(Comparison, BiasIsJudgedWithoutItsSign) {
  Pair pair;
  std::swap(pair.a, pair.b);
  const Comparison comparison = pair.compare(ValueKind::display);
  EXPECT_LT(comparison.differences.largest_bias(), 0);
  EXPECT_FALSE(is_met(comparison, {Metric::bias}, 1e-5));
  EXPECT_TRUE(is_met(comparison, {Metric::bias}, 0.25 / 400 + 1e-9));
}

TEST(Comparison, WhatIsNotThereOrNotANumberNeverPasses) {
  Pair pair;
  EXPECT_FALSE(is_met(pair.compare(ValueKind::data), {Metric::flip}, 1));
  EXPECT_FALSE(is_met(pair.compare(ValueKind::linear), {Metric::ztest}, 0));
  pair.b.pixel(0, 0)[0] = std::nanf("");
  const Comparison comparison = pair.compare(ValueKind::linear);
  for (const Metric metric : {Metric::max, Metric::error, Metric::mse, Metric::rmse, Metric::relmse, Metric::bias})
    EXPECT_FALSE(is_met(comparison, {metric}, 1e30)) << metric_name(metric);
  EXPECT_FALSE(is_met(comparison, {Metric::psnr}, -1e30));
  EXPECT_FALSE(is_met(comparison, {Metric::flip, 1}, 0.999));
}

TEST(ColorMap, HasOneColourForEachLevelEverLighter) {
  const auto& colors = heat_colors();
  EXPECT_EQ(std::set(colors.begin(), colors.end()).size(), 256u);
  const auto luma = [](const auto& color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; };
  for (std::size_t i = 1; i < colors.size(); ++i) EXPECT_GE(luma(colors[i]), luma(colors[i - 1]) - 0.5) << i;
}

TEST(ColorMap, RunsFromZeroToTheLargest) {
  Image map(4, 1, 1);
  map.pixels = {0, 2, 9, std::nanf("")};
  const Image picture = heat_map(map, 4);
  EXPECT_EQ(picture.pixel(0, 0)[2], 4 / 255.0f);
  EXPECT_EQ(picture.pixel(1, 0)[0], heat_colors()[128][0] / 255.0f);
  for (const int x : {2, 3}) EXPECT_EQ(picture.pixel(x, 0)[1], 253 / 255.0f);
}

}  // namespace
}  // namespace candil::test
