#include "metrics/resize.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace candil::test {
namespace {

TEST(ResizeImage, SameSizeIsTheSameImage) {
  Image image(5, 4, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i % 7);
  const Image same = resize_image(image, 5, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_NEAR(same.pixels[i], image.pixels[i], 1e-5f);
}

TEST(ResizeImage, KeepsConstantsAndSlopes) {
  Image flat(10, 6, 1), slope(64, 1, 1);
  std::ranges::fill(flat.pixels, 2.5f);
  for (int x = 0; x < 64; ++x) *slope.pixel(x, 0) = static_cast<float>(x);
  for (const int size : {1, 3, 17, 40})
    for (const float value : resize_image(flat, size, size).pixels) EXPECT_NEAR(value, 2.5f, 1e-5f);
  // Pixel x of 16 lies at 4 x + 1.5 of 64.
  const Image quarter = resize_image(slope, 16, 1);
  for (int x = 1; x < 15; ++x) EXPECT_NEAR(*quarter.pixel(x, 0), 4 * x + 1.5, 1e-4);
}

// Half of the size: weights 1 - |d| / 2 of the pixels at distances 0.5 and 1.5: 3/8 and 1/8.
TEST(ResizeImage, AveragesWhenItShrinks) {
  Image image(8, 1, 1);
  image.pixels = {0, 0, 0, 1, 0, 0, 0, 0};
  const Image half = resize_image(image, 4, 1);
  EXPECT_NEAR(half.pixels[1], 0.375, 1e-6);
  EXPECT_NEAR(half.pixels[2], 0.125, 1e-6);
}

}  // namespace
}  // namespace candil::test
