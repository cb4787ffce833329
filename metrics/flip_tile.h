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
    const float *weights, *whole;  ///< HalfKernel::weights; whole_kernel().
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
inline constexpr int flip_batch = 4, flip_exposures_together = 3;

/// Rows of what has been filtered along, for each image and exposure: luminance, red-green, blue-yellow (wide, narrow),
/// and smooth, edge and point of luminance.
inline constexpr int flip_planes = 7;

/// From row to row, floats: not a power of two, so that rows do not drive each other out of the cache.
inline constexpr std::size_t flip_stride = flip_tile_width + 16;
/// Rows that reach beyond the tile; filters along may look at one vector more.
constexpr std::size_t flip_wide_stride(int radius) {
  return (static_cast<std::size_t>(flip_tile_width) + 2 * static_cast<std::size_t>(radius) + 31) / 16 * 16;
}
/// Rows that the filters of a batch reach.
constexpr int flip_span(int radius) { return 2 * radius + flip_batch; }
/// The planes; three colours and three opponent colours of a row; what is filtered across, of both images; and two of
/// what the map is made of.
constexpr std::size_t flip_scratch_size(int radius) {
  const auto span = static_cast<std::size_t>(flip_span(radius));
  return flip_stride * (2 * flip_exposures_together * flip_planes * span + 2 * flip_planes * flip_batch + 2) +
         flip_wide_stride(radius) * 6;
}
/// The rows of each plane, twice.
constexpr std::size_t flip_rows_size(int radius) {
  return 2 * flip_exposures_together * flip_planes * 2 * static_cast<std::size_t>(flip_span(radius));
}

/// For the processor that the program runs on. All have the same results.
void raise_flip(const FlipTile& tile);

}  // namespace candil
