/// FLIP of a part of two images, in code that is compiled for several levels of x86-64 (core/bvh/target.h).
#pragma once

#include <cstddef>

namespace candil {

/// The image is done in tiles of this size, each on one core; what lies around them is made anew for each. Within a
/// tile rows go through a window as high as the filters, so that everything stays in the processor's cache.
inline constexpr int flip_tile_width = 256, flip_tile_height = 448;

/// FlipFilters as plain arrays.
struct FlipWeights {
  struct Kernel {
    const float* weights;
    int radius;
  };
  Kernel luminance, red_green, blue_yellow_wide, blue_yellow_narrow;
  Kernel blue_yellow_wide_along, blue_yellow_narrow_along;
  Kernel smooth, edge, point;
  int radius;
};

struct FlipTile {
  const float *a, *b;  ///< Whole images, interleaved.
  int width, height, channels;
  bool is_linear;       ///< Else sRGB.
  const float* scales;  ///< Of the exposures: 2^stops.
  int exposures;
  FlipWeights filters;
  float largest_color_difference;
  int x0, y0, x1, y1;
  float* map;          ///< Of the whole image: raised to the largest FLIP of the exposures.
  float* scratch;      ///< flip_scratch_size floats, aligned for vectors (64 bytes).
  const float** rows;  ///< 2 radius + 1, to work with.
};

/// Rows of what goes on in a tile begin at a vector.
constexpr std::size_t flip_stride(int radius) {
  return (static_cast<std::size_t>(flip_tile_width) + 2 * static_cast<std::size_t>(radius) + 15) / 16 * 16;
}
/// Rows: for each image three planes of opponent colours as high as the filters, and seven that are filtered; three of
/// colours, three that are filtered across, and two of what the map is made of.
constexpr std::size_t flip_scratch_size(int radius) {
  const std::size_t span = 2 * static_cast<std::size_t>(radius) + 1;
  return flip_stride(radius) * (2 * (3 * span + 7) + 3 + 3 + 2);
}

/// For the processor that the program runs on. All have the same results.
void raise_flip(const FlipTile& tile);

}  // namespace candil
