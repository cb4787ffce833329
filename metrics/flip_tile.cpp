// Compiled once for each level of x86-64: see core/bvh/target.h and metrics/CMakeLists.txt.
#include "metrics/flip_tile.h"

#include "core/bvh/target.h"
#include "metrics/filter_block.h"
#include "metrics/flip_color.h"
#include "metrics/flip_tone.h"
#include "metrics/pixel_rows.h"

namespace candil {
inline namespace CANDIL_TARGET {

void raise_flip_of_target(const FlipTile& tile);

namespace {

/// From stored values to the light of the screen. Display values: the sRGB curve. Of anything below 0, and of NaN: 0.
[[gnu::always_inline]] inline float screen_light(float value) {
  const float v = value > 0 ? (value < 1 ? value : 1.0f) : 0.0f;
  const float curve = fast_pow((v + 0.055f) * (1 / 1.055f), 2.4f), line = v * (1 / 12.92f);
  return v <= 0.04045f ? line : curve;
}

/// Linear ones: exposed; the tone curve is still to come.
[[gnu::always_inline]] inline float exposed(float value, float scale) {
  constexpr float brightest = 1e3f;  // white by far
  const float v = value * scale;
  return smaller(v > 0 ? v : 0.0f, brightest);
}

/// Logarithms of colour differences: anything below `least` is none.
constexpr float least = 1e-30f, no_power = -1000;

[[gnu::always_inline]] inline float size(float value) { return __builtin_fabsf(value); }
[[gnu::always_inline]] inline float length(float x, float y) { return fast_sqrt(multiply_add(x, x, y * y)); }

// Compilers vectorise loops over pointers that are parameters and do not alias.

void push_display(const float* __restrict red, const float* __restrict green, const float* __restrict blue,
                  float* __restrict luminance, float* __restrict red_green, float* __restrict blue_yellow, int count) {
  for (int i = 0; i < count; ++i) {
    const Opponent color = to_opponent(screen_light(red[i]), screen_light(green[i]), screen_light(blue[i]));
    luminance[i] = color.luminance, red_green[i] = color.red_green, blue_yellow[i] = color.blue_yellow;
  }
}

void push_linear(const float* __restrict red, const float* __restrict green, const float* __restrict blue, float scale,
                 float* __restrict luminance, float* __restrict red_green, float* __restrict blue_yellow, int count) {
  for (int i = 0; i < count; ++i) {
    // One division for the three curves.
    const AcesFraction r = aces_fraction(exposed(red[i], scale)), g = aces_fraction(exposed(green[i], scale));
    const AcesFraction b = aces_fraction(exposed(blue[i], scale));
    const float rg = r.below * g.below, over = 1 / (rg * b.below), over_rg = over * b.below;
    const Opponent color = to_opponent(smaller(r.above * (g.below * over_rg), 1),
                                       smaller(g.above * (r.below * over_rg), 1), smaller(b.above * (rg * over), 1));
    luminance[i] = color.luminance, red_green[i] = color.red_green, blue_yellow[i] = color.blue_yellow;
  }
}

/// The logarithm of the difference of colours, raised to its exponent.
void compare_colors(const float* __restrict a0, const float* __restrict a1, const float* __restrict a2,
                    const float* __restrict b0, const float* __restrict b1, const float* __restrict b2,
                    float* __restrict powers, int count) {
  for (int i = 0; i < count; ++i) {
    const float distance = color_distance(to_hunt_lab({a0[i], a1[i], a2[i]}), to_hunt_lab({b0[i], b1[i], b2[i]}));
    const float power = color_exponent * fast_log2(larger(distance, least));
    powers[i] = distance > least ? power : no_power;
  }
}

/// 1 - the difference of features.
void compare_features(const float* __restrict a3, const float* __restrict a4, const float* __restrict a5,
                      const float* __restrict a6, const float* __restrict b3, const float* __restrict b4,
                      const float* __restrict b5, const float* __restrict b6, float* __restrict rests, int count) {
  for (int i = 0; i < count; ++i) {
    const float edge = size(length(a3[i], a4[i]) - length(b3[i], b4[i]));
    const float point = size(length(a5[i], a6[i]) - length(b5[i], b6[i]));
    // Features differ by sqrt 2 at the most; the paper's exponent is 1/2.
    rests[i] = 1 - fast_sqrt(larger(edge, point) * 0.70710678f);
  }
}

/// How differences of colour become errors: in two straight lines (section 4.1.3).
struct Knee {
  static constexpr float place = 0.4f, height = 0.95f;
  explicit Knee(float largest)
      : low(place * largest),
        low_power(fast_log2(low)),
        slope_power(fast_log2(height / low)),
        upper_slope((1 - height) / (largest - low)) {}
  float low, low_power, slope_power, upper_slope;
};

/// Raises the map below the knee, where nearly all differences are; whether there are others.
bool raise_low(const Knee& knee, const float* __restrict powers, const float* __restrict rests, float* __restrict map,
               int count) {
  const float low_power = knee.low_power, slope_power = knee.slope_power;
  int has_high = 0;
  for (int i = 0; i < count; ++i) {
    const float power = powers[i], shown = fast_exp2((power + slope_power) * rests[i]);
    const bool is_low = power > no_power && power < low_power;
    const float flip = is_low ? shown : 0.0f;
    map[i] = flip > map[i] ? flip : map[i];
    has_high |= power >= low_power ? 1 : 0;
  }
  return has_high != 0;
}

void raise_high(const Knee& knee, const float* __restrict powers, const float* __restrict rests, float* __restrict map,
                int count) {
  const float low = knee.low, low_power = knee.low_power, upper_slope = knee.upper_slope;
  for (int i = 0; i < count; ++i) {
    const float color = multiply_add(fast_exp2(powers[i]) - low, upper_slope, Knee::height);
    const float shown = fast_pow(smaller(color, 1), rests[i]);
    const float flip = powers[i] >= low_power ? shown : 0.0f;
    map[i] = flip > map[i] ? flip : map[i];
  }
}

/// One image at one exposure: rows around those under way, filtered along; row y in slot y mod span.
struct Window {
  float* planes[flip_planes];
  const float** rows[flip_planes];  // all slots of a plane, twice
};

class TileWork {
 public:
  explicit TileWork(const FlipTile& tile)
      : tile_(tile),
        radius_(tile.filters.radius),
        span_(flip_span(radius_)),
        width_(tile.x1 - tile.x0),
        wide_(width_ + 2 * radius_),
        padded_((width_ + filter_lanes - 1) / filter_lanes * filter_lanes),
        knee_(tile.largest_color_difference) {
    float* next = tile.scratch;
    const auto take = [&](std::size_t stride, int rows) {
      float* const taken = next;
      next += stride * static_cast<std::size_t>(rows);
      return taken;
    };
    const float** next_row = tile.rows;
    for (auto& exposure : windows_)
      for (Window& window : exposure)
        for (int plane = 0; plane < flip_planes; ++plane) {
          window.planes[plane] = take(flip_stride, span_);
          window.rows[plane] = next_row;
          for (int i = 0; i < 2 * span_; ++i)
            *next_row++ = window.planes[plane] + static_cast<std::size_t>(i % span_) * flip_stride;
        }
    for (float*& row : colors_) row = take(flip_wide_stride(radius_), 1);
    for (float*& row : opponent_) row = take(flip_wide_stride(radius_), 1);
    for (auto& image : out_)
      for (float*& rows : image) rows = take(flip_stride, flip_batch);
    for (float*& row : parts_) row = take(flip_stride, 1);
  }

  void raise() {
    const int groups = (tile_.exposures + flip_exposures_together - 1) / flip_exposures_together;
    int first = 0;
    for (int left = groups; left > 0; --left) {
      const int count = (tile_.exposures - first + left - 1) / left;
      raise_exposures(first, count);
      first += count;
    }
  }

 private:
  void raise_exposures(int first, int count) {
    int next = tile_.y0 - radius_;
    for (int y = tile_.y0; y < tile_.y1; y += flip_batch) {
      for (; next < y + flip_batch + radius_; ++next)
        for (int image = 0; image < 2; ++image) {
          load_row(image == 0 ? tile_.a : tile_.b, next);
          for (int k = 0; k < count; ++k) push_row(windows_[k][image], next, tile_.scales[first + k]);
        }
      for (int k = 0; k < count; ++k) raise_batch(windows_[k], y);
    }
  }

  int slot(int y) const { return (y + span_) % span_; }  // y is -radius at the least

  /// Row y of the tile and what is around it; outside of the image it continues with its outermost pixels.
  void load_row(const float* image, int y) {
    const int inside_y = y < 0 ? 0 : (y < tile_.height ? y : tile_.height - 1);
    const int x0 = tile_.x0 - radius_, first = x0 < 0 ? -x0 : 0;
    const int last = x0 + wide_ > tile_.width ? tile_.width - x0 : wide_;
    const std::size_t pixel = static_cast<std::size_t>(inside_y) * static_cast<std::size_t>(tile_.width) +
                              static_cast<std::size_t>(x0 + first);
    split_colors(image + pixel * static_cast<std::size_t>(tile_.channels), tile_.channels, last - first,
                 {colors_[0] + first, colors_[1] + first, colors_[2] + first});
    for (float* const values : colors_) {
      for (int i = 0; i < first; ++i) values[i] = values[first];
      for (int i = last; i < wide_; ++i) values[i] = values[last - 1];
    }
  }

  using Kernel = FlipWeights::Kernel;

  /// The row that is loaded, at an exposure, filtered along.
  void push_row(const Window& window, int y, float scale) {
    if (tile_.is_linear)
      push_linear(colors_[0], colors_[1], colors_[2], scale, opponent_[0], opponent_[1], opponent_[2], wide_);
    else
      push_display(colors_[0], colors_[1], colors_[2], opponent_[0], opponent_[1], opponent_[2], wide_);
    float* out[flip_planes];
    for (int plane = 0; plane < flip_planes; ++plane)
      out[plane] = window.planes[plane] + static_cast<std::size_t>(slot(y)) * flip_stride;
    const FlipWeights& filters = tile_.filters;
    const Kernel &smooth = filters.smooth, &edge = filters.edge, &point = filters.point, &contrast = filters.luminance;
    filter_along<true, false, true, true>({{smooth.weights, edge.weights, point.weights, contrast.weights},
                                           {out[4], out[5], out[6], out[0]},
                                           {smooth.radius, edge.radius, point.radius, contrast.radius}},
                                          opponent_[0] + radius_, padded_);
    filter_along<true>({{filters.red_green.weights}, {out[1]}, {filters.red_green.radius}}, opponent_[1] + radius_,
                       padded_);
    const Kernel &first = filters.blue_yellow_wide_along, &second = filters.blue_yellow_narrow_along;
    filter_along<true, true>({{first.weights, second.weights}, {out[2], out[3]}, {first.radius, second.radius}},
                             opponent_[2] + radius_, padded_);
  }

  /// The rows that a kernel reaches from row y on.
  const float* const* rows_of(const Window& window, int plane, int y, int radius) const {
    return window.rows[plane] + slot(y - radius_) + radius_ - radius;
  }

  /// A plane across.
  void filter_across(const Window& window, int plane, int y, const Kernel& kernel, float* out) const {
    const float* const* const rows = rows_of(window, plane, y, kernel.radius);
    for_each_block<across_vectors>([&]<int vectors>(int x) {
      BatchSums<flip_batch, vectors, 1> sums;
      sums.add({kernel.whole}, kernel.radius, rows, x);
      sums.store(0, out, flip_stride, x);
    });
  }

  /// Blue-yellow: two planes, each by its own kernel, added up.
  void filter_sum_across(const Window& window, int y, float* out) const {
    const Kernel &wide = tile_.filters.blue_yellow_wide, &narrow = tile_.filters.blue_yellow_narrow;
    const float* const* const wide_rows = rows_of(window, 2, y, wide.radius);
    const float* const* const narrow_rows = rows_of(window, 3, y, narrow.radius);
    for_each_block<across_vectors>([&]<int vectors>(int x) {
      BatchSums<flip_batch, vectors, 1> sums;
      sums.add({wide.whole}, wide.radius, wide_rows, x);
      sums.add({narrow.whole}, narrow.radius, narrow_rows, x);
      sums.store(0, out, flip_stride, x);
    });
  }

  /// Edges and points across of one plane.
  void filter_features_across(const Window& window, int y, float* edges, float* points) const {
    const Kernel &edge = tile_.filters.edge, &point = tile_.filters.point;  // of one radius
    const float* const* const rows = rows_of(window, 4, y, edge.radius);
    for_each_block<across_vectors / 2>([&]<int vectors>(int x) {
      BatchSums<flip_batch, vectors, 2> sums;
      sums.add({edge.whole, point.whole}, edge.radius, rows, x);
      sums.store(0, edges, flip_stride, x);
      sums.store(1, points, flip_stride, x);
    });
  }

  /// Calls visit<vectors>(x) for all columns, as many at a time as there are registers for, and the rest one by one.
  template <int vectors, typename Visit>
  void for_each_block(const Visit& visit) const {
    int x = 0;
    for (; x + vectors * filter_lanes <= padded_; x += vectors * filter_lanes) visit.template operator()<vectors>(x);
    for (; x < padded_; x += filter_lanes) visit.template operator()<1>(x);
  }
  static constexpr int across_vectors = filter_lanes == 16 ? 4 : 2;

  /// The rows of a batch across: luminance, red-green, blue-yellow, then edges and points in both directions.
  void filter_rows(const Window& window, int y, float* const* out) const {
    const FlipWeights& filters = tile_.filters;
    filter_across(window, 0, y, filters.luminance, out[0]);
    filter_across(window, 1, y, filters.red_green, out[1]);
    filter_sum_across(window, y, out[2]);
    filter_features_across(window, y, out[3], out[5]);
    filter_across(window, 5, y, filters.smooth, out[4]);
    filter_across(window, 6, y, filters.smooth, out[6]);
  }

  /// Rows up to the radius around those of the batch have been pushed. Some may be below the tile.
  void raise_batch(const Window (&windows)[2], int y) {
    for (int image = 0; image < 2; ++image) filter_rows(windows[image], y, out_[image]);
    for (int i = 0; i < flip_batch && y + i < tile_.y1; ++i)
      raise_row(y + i, static_cast<std::size_t>(i) * flip_stride);
  }

  /// Sections 4.1.3, 4.2 and 4.3 of the paper of 2020, for the filtered rows of both images, `place` of the batch.
  void raise_row(int y, std::size_t place) {
    const float *a[flip_planes], *b[flip_planes];
    for (int i = 0; i < flip_planes; ++i) a[i] = out_[0][i] + place, b[i] = out_[1][i] + place;
    compare_colors(a[0], a[1], a[2], b[0], b[1], b[2], parts_[0], padded_);
    compare_features(a[3], a[4], a[5], a[6], b[3], b[4], b[5], b[6], parts_[1], padded_);
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(tile_.width);
    float* const map = tile_.map + pixel + static_cast<std::size_t>(tile_.x0);
    if (raise_low(knee_, parts_[0], parts_[1], map, width_)) raise_high(knee_, parts_[0], parts_[1], map, width_);
  }

  const FlipTile& tile_;
  int radius_, span_;
  int width_, wide_, padded_;  // of the tile; with what is around it; in whole vectors
  Knee knee_;
  Window windows_[flip_exposures_together][2];
  float *colors_[3], *opponent_[3], *out_[2][flip_planes], *parts_[2];
};

}  // namespace

void raise_flip_of_target(const FlipTile& tile) { TileWork(tile).raise(); }

}  // namespace CANDIL_TARGET
}  // namespace candil
