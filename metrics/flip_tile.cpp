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
  return v > 0 ? (v < brightest ? v : brightest) : 0.0f;
}

/// Logarithms of colour differences: anything below `least` is none.
constexpr float least = 1e-30f, no_power = -1000;

[[gnu::always_inline]] inline float at_most_1(float value) { return value < 1 ? value : 1.0f; }
[[gnu::always_inline]] inline float size(float value) { return value < 0 ? -value : value; }
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
    const Opponent color = to_opponent(at_most_1(r.above * (g.below * over_rg)),
                                       at_most_1(g.above * (r.below * over_rg)), at_most_1(b.above * (rg * over)));
    luminance[i] = color.luminance, red_green[i] = color.red_green, blue_yellow[i] = color.blue_yellow;
  }
}

/// The color difference of two rows that are filtered, raised to its exponent: its logarithm.
/// sizes: of the colour difference, 0 where there is none.
void compare_colors(const float* __restrict a0, const float* __restrict a1, const float* __restrict a2,
                    const float* __restrict b0, const float* __restrict b1, const float* __restrict b2,
                    float* __restrict powers, int count) {
  for (int i = 0; i < count; ++i) {
    const float distance = color_distance(to_hunt_lab({a0[i], a1[i], a2[i]}), to_hunt_lab({b0[i], b1[i], b2[i]}));
    const float power = color_exponent * fast_log2(distance > least ? distance : least);
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
    rests[i] = 1 - fast_sqrt((edge > point ? edge : point) * 0.70710678f);
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
    const float shown = fast_pow(at_most_1(color), rests[i]);
    const float flip = powers[i] >= low_power ? shown : 0.0f;
    map[i] = flip > map[i] ? flip : map[i];
  }
}

/// Rows of one image, in the tile's scratch.
struct Window {
  const float* image;
  float* planes[3];  // opponent colours, row y in slot y mod span
  float* out[7];     // filtered: luminance, red-green, blue-yellow; edges and points, along and across
};

class TileWork {
 public:
  explicit TileWork(const FlipTile& tile)
      : tile_(tile),
        radius_(tile.filters.radius),
        span_(2 * radius_ + 1),
        stride_(flip_stride(radius_)),
        wide_(tile.x1 - tile.x0 + 2 * radius_),
        knee_(tile.largest_color_difference) {
    float* next = tile.scratch;
    const auto take = [&](int rows) {
      float* const taken = next;
      next += stride_ * static_cast<std::size_t>(rows);
      return taken;
    };
    a_.image = tile.a, b_.image = tile.b;
    for (Window* const window : {&a_, &b_}) {
      for (float*& plane : window->planes) plane = take(span_);
      for (float*& row : window->out) row = take(1);
    }
    for (float*& row : colors_) row = take(1);
    for (float*& row : across_) row = take(1);
    for (float*& row : parts_) row = take(1);
  }

  void raise() {
    for (int k = 0; k < tile_.exposures; ++k)
      for (int y = tile_.y0 - radius_; y < tile_.y1 + radius_; ++y) {
        push_row(a_, y, tile_.scales[k]);
        push_row(b_, y, tile_.scales[k]);
        const int done = y - radius_;
        if (done < tile_.y0) continue;
        filter_row(a_, done);
        filter_row(b_, done);
        raise_row(done);
      }
  }

 private:
  float* row(const Window& window, int channel, int y) const {
    const int slot = (y + span_) % span_;  // y is -radius at the least
    return window.planes[channel] + static_cast<std::size_t>(slot) * stride_;
  }

  /// Row y of the tile and what is around it; outside of the image it continues with its outermost pixels.
  void push_row(const Window& window, int y, float scale) {
    load_row(window.image, y);
    float *const luminance = row(window, 0, y), *const red_green = row(window, 1, y);
    float* const blue_yellow = row(window, 2, y);
    if (tile_.is_linear)
      push_linear(colors_[0], colors_[1], colors_[2], scale, luminance, red_green, blue_yellow, wide_);
    else
      push_display(colors_[0], colors_[1], colors_[2], luminance, red_green, blue_yellow, wide_);
  }

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

  /// The rows around row y, for filters across them.
  const float* const* rows_around(const Window& window, int channel, int y) const {
    for (int k = -radius_; k <= radius_; ++k) tile_.rows[radius_ + k] = row(window, channel, y + k);
    return tile_.rows + radius_;
  }

  /// Rows up to the radius around row y have been pushed.
  void filter_row(const Window& window, int y) {
    const FlipWeights& filters = tile_.filters;
    const int width = tile_.x1 - tile_.x0;
    float *const first = across_[0], *const second = across_[1], *const third = across_[2];
    float* const* const out = window.out;
    const auto symmetric = [&](const FlipWeights::Kernel& kernel, const float* in, float* to, bool adds) {
      filter_along<true>({{kernel.weights}, {to}, kernel.radius, adds}, in + radius_, width);
    };
    const float* const* rows = rows_around(window, 0, y);
    filter_across<true>({{filters.luminance.weights}, {first}, filters.luminance.radius}, rows, wide_);
    symmetric(filters.luminance, first, out[0], false);
    filter_across<true, false, true>({{filters.smooth.weights, filters.edge.weights, filters.point.weights},
                                      {first, second, third},
                                      filters.smooth.radius},
                                     rows, wide_);
    filter_along<false, true>({{filters.edge.weights, filters.point.weights}, {out[3], out[5]}, filters.edge.radius},
                              first + radius_, width);
    symmetric(filters.smooth, second, out[4], false);
    symmetric(filters.smooth, third, out[6], false);

    rows = rows_around(window, 1, y);
    filter_across<true>({{filters.red_green.weights}, {first}, filters.red_green.radius}, rows, wide_);
    symmetric(filters.red_green, first, out[1], false);

    rows = rows_around(window, 2, y);
    const FlipWeights::Kernel &wide = filters.blue_yellow_wide, &narrow = filters.blue_yellow_narrow;
    if (wide.radius == narrow.radius) {
      filter_across<true, true>({{wide.weights, narrow.weights}, {first, second}, wide.radius}, rows, wide_);
    } else {
      filter_across<true>({{wide.weights}, {first}, wide.radius}, rows, wide_);
      filter_across<true>({{narrow.weights}, {second}, narrow.radius}, rows, wide_);
    }
    symmetric(filters.blue_yellow_wide_along, first, out[2], false);
    symmetric(filters.blue_yellow_narrow_along, second, out[2], true);
  }

  /// Sections 4.1.3, 4.2 and 4.3 of the paper of 2020, for the filtered rows of both windows.
  void raise_row(int y) {
    const int width = tile_.x1 - tile_.x0;
    compare_colors(a_.out[0], a_.out[1], a_.out[2], b_.out[0], b_.out[1], b_.out[2], parts_[0], width);
    compare_features(a_.out[3], a_.out[4], a_.out[5], a_.out[6], b_.out[3], b_.out[4], b_.out[5], b_.out[6], parts_[1],
                     width);
    const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(tile_.width);
    float* const map = tile_.map + pixel + static_cast<std::size_t>(tile_.x0);
    if (raise_low(knee_, parts_[0], parts_[1], map, width)) raise_high(knee_, parts_[0], parts_[1], map, width);
  }

  const FlipTile& tile_;
  int radius_, span_;
  std::size_t stride_;
  int wide_;
  Window a_, b_;
  Knee knee_;
  float *colors_[3], *across_[3], *parts_[2];
};

}  // namespace

void raise_flip_of_target(const FlipTile& tile) { TileWork(tile).raise(); }

}  // namespace CANDIL_TARGET
}  // namespace candil
