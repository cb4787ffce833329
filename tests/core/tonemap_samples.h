/// Small images and what operators show of them.
#pragma once

#include <vector>

#include "core/tonemap.h"
#include "tests/support/expect_near.h"

namespace candil::test {

/// One row of RGB pixels.
Image row_of(const std::vector<Vec3>& colors);
/// One row of greys.
Image row_of_greys(const std::vector<float>& greys);

/// What to_display() gives, pixel by pixel.
std::vector<Vec3> display_values(const Image& image, const Tonemap& tonemap, float exposure = 0);
/// The same without the sRGB curve.
std::vector<Vec3> linear_values(const Image& image, const Tonemap& tonemap, float exposure = 0);
/// Of a single pixel, without the sRGB curve.
Vec3 linear_value(Vec3 color, const Tonemap& tonemap);

}  // namespace candil::test
