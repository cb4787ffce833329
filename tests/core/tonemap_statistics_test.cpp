#include "core/tonemap_statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/tonemap_samples.h"

namespace candil {
namespace {

using test::row_of;
using test::row_of_greys;

// Greys 1, 4 and 16: mean 7, log-average the cube root of 64.
TEST(MeasureImage, KnowsAverages) {
  const ImageStatistics statistics = measure_image(row_of_greys({1, 4, 16}));
  EXPECT_DOUBLE_EQ(statistics.maximum, 16);
  EXPECT_NEAR(statistics.mean_luminance, 7, 1e-12);
  EXPECT_NEAR(statistics.log_average, 4, 1e-12);
  EXPECT_NEAR(statistics.lowest_luminance, 1, 1e-12);
  EXPECT_NEAR(statistics.highest_luminance, 16, 1e-12);
}

// Black counts in the mean, and nothing else; what is not finite counts nowhere; negative values are 0.
TEST(MeasureImage, SortsPixelsOut) {
  const ImageStatistics statistics =
      measure_image(row_of({{2, 2, 2}, {0, 0, 0}, {std::nanf(""), 5, 5}, {5, infinity, 5}, {-9, -9, -9}, {8, 8, 8}}));
  EXPECT_DOUBLE_EQ(statistics.maximum, 8);
  EXPECT_NEAR(statistics.mean_luminance, 10.0 / 4, 1e-12);
  EXPECT_NEAR(statistics.log_average, 4, 1e-12);
  EXPECT_NEAR(statistics.lowest_luminance, 2, 1e-12);
}

// (0.5, 0, 0) of alpha 0.5 is (1, 0, 0), whose luminance is 0.2126; the empty pixel is no part of the picture.
TEST(MeasureImage, DividesByAlpha) {
  Image image(2, 1, 4);
  image.pixels = {0.5f, 0, 0, 0.5f, 0, 0, 0, 0};
  const ImageStatistics statistics = measure_image(image);
  EXPECT_DOUBLE_EQ(statistics.maximum, 1);
  EXPECT_NEAR(statistics.mean_luminance, 0.2126, 1e-12);
  EXPECT_NEAR(statistics.mean_color.x, 1, 1e-12);
}

// The sum of 3e38 twice is above what a float holds.
TEST(MeasureImage, DoesNotOverflow) {
  const ImageStatistics statistics = measure_image(row_of_greys({3e38f, 3e38f}));
  EXPECT_NEAR(statistics.mean_luminance / 3e38, 1, 1e-6);
  EXPECT_NEAR(statistics.log_average / 3e38, 1, 1e-6);
}

TEST(MeasureImage, IsZeroForBlack) {
  const ImageStatistics statistics = measure_image(row_of_greys({0, 0}));
  EXPECT_EQ(statistics.maximum, 0);
  EXPECT_EQ(statistics.mean_luminance, 0);
  EXPECT_EQ(statistics.log_average, 0);
  EXPECT_EQ(statistics.lowest_luminance, 0);
}

}  // namespace
}  // namespace candil
