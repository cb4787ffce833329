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
  const float** rows;  ///< flip_rows_size pointers, to work with.
};

/// Some rows are filtered together, while the cache of the first level has what they share; some exposures go through
/// the tile together, while that of the second level has their rows.
inline constexpr int flip_batch = 4, flip_exposures_together = 4;

/// Rows of what goes on in a tile begin at a vector.
constexpr std::size_t flip_stride(int radius) {
  return (static_cast<std::size_t>(flip_tile_width) + 2 * static_cast<std::size_t>(radius) + 15) / 16 * 16;
}
/// Of opponent colours that the filters of a batch reach.
constexpr int flip_span(int radius) { return 2 * radius + flip_batch; }
/// Rows: for each image and exposure three planes; of each image seven that are filtered, and seven for each row of a
/// batch that are filtered across; three of colours, and two of what the map is made of.
constexpr std::size_t flip_scratch_size(int radius) {
  const auto span = static_cast<std::size_t>(flip_span(radius));
  return flip_stride(radius) * (2 * flip_exposures_together * 3 * span + 2 * 7 + 2 * 7 * flip_batch + 3 + 2);
}
/// The rows of each plane, twice.
constexpr std::size_t flip_rows_size(int radius) {
  return 2 * flip_exposures_together * 3 * 2 * static_cast<std::size_t>(flip_span(radius));
}

/// For the processor that the program runs on. All have the same results.
void raise_flip(const FlipTile& tile);

}  // namespace candil
