#include "metrics/flip.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <list>
#include <vector>

#include "metrics/flip_color.h"
#include "metrics/flip_filters.h"
#include "metrics/flip_tile.h"
#include "metrics/parallel_rows.h"
#include "metrics/pixel_rows.h"

namespace candil {
namespace {

/// FlipFilters in the form that tiles take.
class PlainFilters {
 public:
  explicit PlainFilters(const FlipFilters& filters)
      : plain_{plain(filters.luminance),
               plain(filters.red_green),
               plain(filters.blue_yellow_wide),
               plain(filters.blue_yellow_narrow),
               plain(filters.blue_yellow_wide_along),
               plain(filters.blue_yellow_narrow_along),
               plain(filters.smooth),
               plain(filters.edge),
               plain(filters.point),
               filters.radius} {}

  const FlipWeights& weights() const { return plain_; }

 private:
  FlipWeights::Kernel plain(const HalfKernel& kernel) {
    wholes_.push_back(whole_kernel(kernel));
    return {kernel.weights.data(), wholes_.back().data(), kernel.radius()};
  }

  std::list<std::vector<float>> wholes_;
  FlipWeights plain_;
};

/// What a tile is worked on in.
class Scratch {
 public:
  explicit Scratch(int radius) : values_(flip_scratch_size(radius) + line), rows_(flip_rows_size(radius)) {}

  /// From the first line of the cache on.
  float* values() {
    const auto past = reinterpret_cast<std::uintptr_t>(values_.data()) / sizeof(float) % line;
    return values_.data() + (line - past) % line;
  }
  const float** rows() { return rows_.data(); }

 private:
  static constexpr std::size_t line = 64 / sizeof(float);
  std::vector<float> values_;
  std::vector<const float*> rows_;
};

/// No eye sees them, and no threshold is to let them pass.
void mark_non_finite(const ImagePair& pair, Image& map) {
  const int channels = pair.a.channels;
  for_each_row(pair.height(), [&](int y) {
    const float *a = pair.a.pixel(0, y), *b = pair.b.pixel(0, y);
    const auto count = static_cast<std::size_t>(pair.width()) * static_cast<std::size_t>(channels);
    if (is_finite_row(a, count) && is_finite_row(b, count)) return;
    for (int x = 0; x < pair.width(); ++x)
      for (int c = 0; c < 3; ++c)
        if (std::abs(difference(a[x * channels + c], b[x * channels + c])) == infinity) *map.pixel(x, y) = 1;
  });
}

}  // namespace

Flip measure_flip(const ImagePair& pair, const FlipSettings& settings) {
  Flip flip;
  flip.map = Image(pair.width(), pair.height(), 1);
  FlipExposures exposures;
  if (pair.kind == ValueKind::linear) {
    exposures = settings.exposures ? *settings.exposures : flip_exposures(pair.a);
    flip.exposures = exposures;
  }
  std::vector<float> scales;
  for (int k = 0; k < exposures.count; ++k) scales.push_back(std::exp2(exposures.stops(k)));
  const FlipFilters filters = make_flip_filters(settings.pixels_per_degree);
  const PlainFilters plain(filters);
  const int width = pair.width(), height = pair.height();
  const FlipTile whole = {pair.a.pixels.data(),
                          pair.b.pixels.data(),
                          width,
                          height,
                          pair.a.channels,
                          pair.kind == ValueKind::linear,
                          scales.data(),
                          exposures.count,
                          plain.weights(),
                          largest_color_difference(),
                          0,
                          0,
                          width,
                          height,
                          flip.map.pixels.data(),
                          nullptr,
                          nullptr};
  const int columns = (width + flip_tile_width - 1) / flip_tile_width;
  const int rows = (height + flip_tile_height - 1) / flip_tile_height;
  for_each_part(columns * rows, [&](int i) {
    Scratch scratch(filters.radius);
    FlipTile tile = whole;
    tile.x0 = i % columns * flip_tile_width, tile.y0 = i / columns * flip_tile_height;
    tile.x1 = std::min(tile.x0 + flip_tile_width, width), tile.y1 = std::min(tile.y0 + flip_tile_height, height);
    tile.scratch = scratch.values(), tile.rows = scratch.rows();
    raise_flip(tile);
  });
  mark_non_finite(pair, flip.map);
  return flip;
}

}  // namespace candil
