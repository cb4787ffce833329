/// Metrics of single values, by hand.
#include "metrics/differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace candil::test {
namespace {

Image row_of(std::vector<float> values, int channels) {
  Image image(static_cast<int>(values.size()) / channels, 1, channels);
  image.pixels = std::move(values);
  return image;
}

Differences measure_all(const Image& a, const Image& b, ValueKind kind = ValueKind::linear) {
  return measure_differences({a, b, kind}, PixelSelection(a.width, a.height));
}

// d is (0.5, 0, -1) and (0, 0, 0). Squares: 0.25 and 1; over a^2 + 0.01: 0.25 / 1.01 and 1 / 4.01. Six values.
TEST(Differences, ClosedForm) {
  const Image a = row_of({1, 3, 2, 0, 0, 4}, 3), b = row_of({1.5f, 3, 1, 0, 0, 4}, 3);
  const Differences d = measure_all(a, b);
  EXPECT_EQ(d.pixels, 2u);
  EXPECT_EQ(d.different_pixels, 1u);
  EXPECT_EQ(d.non_finite_pixels, 0u);
  EXPECT_EQ(d.largest, 1);
  EXPECT_EQ(d.largest_x, 0);
  EXPECT_EQ(d.largest_channel, 2);
  EXPECT_DOUBLE_EQ(d.mean_absolute, 1.5 / 6);
  EXPECT_DOUBLE_EQ(d.mean_squared, 1.25 / 6);
  EXPECT_DOUBLE_EQ(d.root_mean_squared(), std::sqrt(1.25 / 6));
  EXPECT_NEAR(d.relative_mean_squared, (0.25 / 1.01 + 1 / 4.01) / 6, 1e-12);
  EXPECT_EQ(d.bias, (std::vector<double>{0.25, 0, -0.5}));
  EXPECT_EQ(d.largest_bias(), -0.5);
  EXPECT_EQ(d.error.pixels, (std::vector<float>{1, 0}));
  // The largest value of A is 4.
  EXPECT_DOUBLE_EQ(d.peak_signal_to_noise(), 10 * std::log10(16 / (1.25 / 6)));
  EXPECT_DOUBLE_EQ(measure_all(a, b, ValueKind::display).peak_signal_to_noise(), 10 * std::log10(1 / (1.25 / 6)));
}

// Rows that count as a whole go another way than those of a selection; sums of doubles in another order.
TEST(Differences, OfAllPixelsAreThoseOfASelectionOfAll) {
  for (const int channels : {3, 4})
    for (const int width : {1, 5, 29}) {
      Image a(width, 7, channels), b = a;
      std::uint32_t state = 1;
      for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        a.pixels[i] = static_cast<float>(state >> 8) / 16777216.0f - 0.3f;
        b.pixels[i] = i % 5 == 0 ? a.pixels[i] : 1 - a.pixels[i];
      }
      b.pixel(0, 3)[channels - 1] = -2;  // the largest, in the last channel
      a.pixel(width - 1, 6)[1] = std::nanf("");
      PixelSelection everything(width, 7);
      everything.keep(std::vector<Region>{{0, 0, width, 7}});
      const Differences whole = measure_all(a, b), selected = measure_differences({a, b}, everything);
      EXPECT_EQ(whole.different_pixels, selected.different_pixels);
      EXPECT_EQ(whole.non_finite_pixels, 1u);
      EXPECT_EQ(whole.error.pixels, selected.error.pixels);
      EXPECT_EQ(whole.peak, selected.peak);
      EXPECT_EQ(whole.largest, infinity);
      EXPECT_EQ(whole.largest_x, selected.largest_x);
      EXPECT_EQ(whole.largest_y, selected.largest_y);
      EXPECT_EQ(whole.largest_channel, selected.largest_channel);
      a.pixel(width - 1, 6)[1] = 0;
      const Differences finite = measure_all(a, b), finite_selected = measure_differences({a, b}, everything);
      EXPECT_EQ(finite.largest, finite_selected.largest);
      EXPECT_EQ(finite.largest_x, 0);
      EXPECT_EQ(finite.largest_y, 3);
      EXPECT_EQ(finite.largest_channel, channels - 1);
      EXPECT_NEAR(finite.mean_absolute, finite_selected.mean_absolute, 1e-12);
      EXPECT_NEAR(finite.mean_squared, finite_selected.mean_squared, 1e-12);
      EXPECT_NEAR(finite.relative_mean_squared, finite_selected.relative_mean_squared, 1e-10);
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
        EXPECT_NEAR(finite.bias[c], finite_selected.bias[c], 1e-12);
    }
}

TEST(Differences, OfEqualImagesAreNone) {
  const Image a = row_of({1, -2, 0.5f, 3}, 1);
  const Differences d = measure_all(a, a);
  EXPECT_EQ(d.different_pixels, 0u);
  EXPECT_EQ(d.largest, 0);
  EXPECT_EQ(d.mean_squared, 0);
  EXPECT_EQ(d.peak_signal_to_noise(), std::numeric_limits<double>::infinity());
}

TEST(Differences, SwappingImagesTurnsTheBiasOnly) {
  const Image a = row_of({1, 3, 2, 0.25f}, 4), b = row_of({0.5f, 2, 2, 0.75f}, 4);
  const Differences forth = measure_all(a, b), back = measure_all(b, a);
  EXPECT_EQ(forth.mean_squared, back.mean_squared);
  EXPECT_EQ(forth.largest, back.largest);
  EXPECT_EQ(forth.mean_absolute, back.mean_absolute);
  for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(forth.bias[c], -back.bias[c]);
}

TEST(Differences, WhatIsNotFiniteDiffersInfinitelyUnlessItIsTheSame) {
  const float nan = std::nanf("");
  const Image same = row_of({nan, infinity, -infinity, 1}, 1);
  EXPECT_EQ(measure_all(same, same).different_pixels, 0u);
  for (const auto& [a, b] : {std::pair{nan, 1.0f}, {1.0f, nan}, {infinity, 1.0f}, {-infinity, infinity}}) {
    const Differences d = measure_all(row_of({a, 1}, 1), row_of({b, 1}, 1));
    EXPECT_EQ(d.non_finite_pixels, 1u) << a << ' ' << b;
    EXPECT_EQ(d.largest, infinity);
    EXPECT_EQ(d.mean_squared, infinity);
    EXPECT_EQ(d.relative_mean_squared, infinity);
    EXPECT_EQ(d.peak_signal_to_noise(), -infinity);
    EXPECT_FALSE(std::abs(d.largest_bias()) < 1e30);
  }
}

TEST(Differences, OnlySelectedPixelsCount) {
  const Image a = row_of({0, 0, 0, 0}, 1), b = row_of({9, 1, 2, 9}, 1);
  PixelSelection selection(4, 1);
  selection.keep(std::vector<Region>{{1, 0, 3, 1}});
  Image mask = row_of({1, 0.5f, 0.7f, 0.4f}, 1);
  selection.keep(mask);
  EXPECT_EQ(selection.count(), 2u);
  const Differences d = measure_differences({a, b, ValueKind::data}, selection);
  EXPECT_EQ(d.different_pixels, 2u);
  EXPECT_EQ(d.largest, 2);
  EXPECT_EQ(d.largest_x, 2);
  EXPECT_DOUBLE_EQ(d.mean_squared, 2.5);
  EXPECT_EQ(d.error.pixels, (std::vector<float>{9, 1, 2, 9}));  // the map has all
}

TEST(Differences, SeveralRegionsAreTheirUnion) {
  PixelSelection selection(5, 2);
  selection.keep(std::vector<Region>{{0, 0, 2, 1}, {1, 0, 2, 2}});
  EXPECT_EQ(selection.count(), 5u);
  EXPECT_TRUE(selection.contains(0, 0));
  EXPECT_FALSE(selection.contains(0, 1));
  EXPECT_TRUE(selection.contains(2, 1));
}

}  // namespace
}  // namespace candil::test
