#include "metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "metrics/fast_math.h"
#include "metrics/flip_color.h"
#include "metrics/flip_filters.h"
#include "metrics/flip_tone.h"
#include "metrics/parallel_rows.h"
#include "metrics/pixel_rows.h"

namespace candil {
namespace {

/// The image is done in tiles of this size, each on one core; what lies around them is made anew for each. Within a
/// tile rows go through a window as high as the filters, so that everything stays in the processor's cache.
constexpr int tile_width = 256, tile_height = 448;

struct Tile {
  int x0, y0, x1, y1;
  int width() const { return x1 - x0; }
};

/// From stored values to the light of the screen, in place. Display values: the sRGB curve. Linear ones: exposed, then
/// the tone curve. Of anything below 0, and of NaN: 0.
struct ToScreen {
  ValueKind kind;
  float scale;  // 2^stops

  void operator()(float* values, int count) const {
    if (kind == ValueKind::display) {
      for (int i = 0; i < count; ++i) {
        const float v = values[i] > 0 ? (values[i] < 1 ? values[i] : 1.0f) : 0.0f;
        const float curve = fast_pow((v + 0.055f) * (1 / 1.055f), 2.4f), line = v * (1 / 12.92f);
        values[i] = v <= 0.04045f ? line : curve;
      }
      return;
    }
    constexpr float brightest = 1e6f;  // white by far
    for (int i = 0; i < count; ++i) {
      const float v = values[i] * scale;
      values[i] = aces_curve(v > 0 ? (v < brightest ? v : brightest) : 0.0f);
    }
  }
};

/// The rows of one image around the row under way, in opponent colours; as wide as the tile and the filters around it.
class Window {
 public:
  Window(const Image& image, const FlipFilters& filters)
      : image_(image), filters_(filters), span_(2 * filters.radius + 1), stride_(tile_width + 2 * filters.radius) {
    const auto wide = static_cast<std::size_t>(stride_);
    for (auto& row : colors_) row.resize(wide);
    for (auto& plane : planes_) plane.resize(wide * static_cast<std::size_t>(span_));
    for (auto& row : across_) row.resize(wide);
    for (auto& row : out_) row.resize(tile_width);
  }

  /// Row y may lie outside of the image: it continues with its outermost pixels.
  void push_row(const Tile& tile, int y, const ToScreen& to_screen) {
    const int wide = tile.width() + 2 * filters_.radius;
    load(tile.x0 - filters_.radius, std::clamp(y, 0, image_.height - 1), wide, to_screen);
    to_opponent(colors_[0].data(), colors_[1].data(), colors_[2].data(), {row(0, y), row(1, y), row(2, y)}, wide);
  }

  /// What the filters give for row y; rows up to the radius around it have been pushed.
  void filter_row(int y, int width) {
    const int wide = width + 2 * filters_.radius;
    constexpr int luminance = 0, red_green = 1, blue_yellow = 2;
    const auto across = [&](int channel, const auto&... tasks) { filter_across(channel, y, wide, tasks...); };
    const auto out = [&](std::size_t i) { return out_[i].data(); };
    float *const first = across_[0].data(), *const second = across_[1].data(), *const third = across_[2].data();
    across(luminance, FilterTask{filters_.luminance, first});
    filter_along(first, width, FilterTask{filters_.luminance, out(0)});
    across(red_green, FilterTask{filters_.red_green, first});
    filter_along(first, width, FilterTask{filters_.red_green, out(1)});
    across(blue_yellow, FilterTask{filters_.blue_yellow_wide, first}, FilterTask{filters_.blue_yellow_narrow, second});
    filter_along(first, width, FilterTask{filters_.blue_yellow_wide_along, out(2)});
    filter_along(second, width, FilterTask{filters_.blue_yellow_narrow_along, out(3)});
    for (int i = 0; i < width; ++i) out_[2][i] += out_[3][i];

    across(luminance, FilterTask{filters_.smooth, first}, FilterTask{filters_.edge, second},
           FilterTask{filters_.point, third});
    filter_along(first, width, FilterTask{filters_.edge, out(3)}, FilterTask{filters_.point, out(5)});
    filter_along(second, width, FilterTask{filters_.smooth, out(4)});
    filter_along(third, width, FilterTask{filters_.smooth, out(6)});
    to_hunt_lab({out_[0].data(), out_[1].data(), out_[2].data()}, width);
    const auto lengths = [width](float* __restrict x, const float* __restrict y_part) {
      for (int i = 0; i < width; ++i) x[i] = std::sqrt(multiply_add(x[i], x[i], y_part[i] * y_part[i]));
    };
    lengths(out_[3].data(), out_[4].data());
    lengths(out_[5].data(), out_[6].data());
  }

  const float* lightness() const { return out_[0].data(); }
  const float* red_green() const { return out_[1].data(); }
  const float* blue_yellow() const { return out_[2].data(); }
  const float* edges() const { return out_[3].data(); }
  const float* points() const { return out_[5].data(); }

 private:
  float* row(int channel, int y) {
    const int slot = (y + span_) % span_;  // y is -radius at the least
    return &planes_[static_cast<std::size_t>(channel)][static_cast<std::size_t>(slot) * stride_];
  }

  template <typename... Tasks>
  void filter_across(int channel, int y, int wide, const Tasks&... tasks) {
    const int radius = std::max({tasks.kernel.radius()...});
    rows_.clear();
    for (int k = -radius; k <= radius; ++k) rows_.push_back(row(channel, y + k));
    const FilterTask list[] = {tasks...};
    filter_across_rows(list, rows_, wide);
  }

  template <typename... Tasks>
  void filter_along(const float* in, int width, const Tasks&... tasks) {
    const FilterTask list[] = {tasks...};
    filter_along_row(list, in + filters_.radius, width);
  }

  /// `wide` pixels of row y from x0 on; before and after the image its outermost ones.
  void load(int x0, int y, int wide, const ToScreen& to_screen) {
    const int first = std::clamp(-x0, 0, wide), last = std::clamp(image_.width - x0, first, wide);
    const float* const pixels = image_.pixel(x0 + first, y);
    const std::array<float*, 3> out = {&colors_[0][first], &colors_[1][first], &colors_[2][first]};
    split_colors(pixels, image_.channels, last - first, out);
    for (std::vector<float>& row : colors_) {
      to_screen(row.data() + first, last - first);
      std::fill(row.begin(), row.begin() + first, row[first]);
      std::fill(row.begin() + last, row.begin() + wide, row[last - 1]);
    }
  }

  const Image& image_;
  const FlipFilters& filters_;
  int span_, stride_;
  std::array<std::vector<float>, 3> colors_;
  std::array<std::vector<float>, 3> planes_;  // opponent colours, row y in slot y mod span_
  std::array<std::vector<float>, 3> across_;
  std::vector<const float*> rows_;
  std::array<std::vector<float>, 7> out_;
};

/// Sections 4.1.3, 4.2 and 4.3 of the paper of 2020.
class Differ {
 public:
  Differ() : largest_(largest_color_difference()) {}

  /// Raises the row of the map to the FLIP of the two windows' rows.
  void raise(const Window& a, const Window& b, int width, float* __restrict map) const {
    constexpr float knee = 0.4f, knee_height = 0.95f;
    const float low = knee * largest_, slope = knee_height / low;
    const float upper_slope = (1 - knee_height) / (largest_ - low);
    const float *la = a.lightness(), *ra = a.red_green(), *ya = a.blue_yellow(), *ea = a.edges(), *pa = a.points();
    const float *lb = b.lightness(), *rb = b.red_green(), *yb = b.blue_yellow(), *eb = b.edges(), *pb = b.points();
    for (int i = 0; i < width; ++i) {
      const float dr = ra[i] - rb[i], dy = ya[i] - yb[i];
      const float distance = std::abs(la[i] - lb[i]) + std::sqrt(multiply_add(dr, dr, dy * dy));
      const float power = fast_pow(distance, color_exponent);
      const float color = power < low ? power * slope : multiply_add(power - low, upper_slope, knee_height);
      const float edge = std::abs(ea[i] - eb[i]), point = std::abs(pa[i] - pb[i]);
      // Features differ by sqrt 2 at the most; the paper's exponent is 1/2.
      const float feature = std::sqrt((edge > point ? edge : point) * 0.70710678f);
      const float flip = fast_pow(color, 1 - feature);
      map[i] = flip > map[i] ? flip : map[i];
    }
  }

 private:
  float largest_;
};

class TileWork {
 public:
  TileWork(const ImagePair& pair, const FlipFilters& filters)
      : pair_(pair), filters_(filters), a_(pair.a, filters), b_(pair.b, filters) {}

  void raise(const Tile& tile, float stops, Image& map) {
    const ToScreen to_screen = {pair_.kind, std::exp2(stops)};
    const int radius = filters_.radius;
    for (int y = tile.y0 - radius; y < tile.y1 + radius; ++y) {
      a_.push_row(tile, y, to_screen);
      b_.push_row(tile, y, to_screen);
      const int done = y - radius;
      if (done < tile.y0) continue;
      a_.filter_row(done, tile.width());
      b_.filter_row(done, tile.width());
      differ_.raise(a_, b_, tile.width(), map.pixel(tile.x0, done));
    }
  }

 private:
  const ImagePair& pair_;
  const FlipFilters& filters_;
  Window a_, b_;
  Differ differ_;
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
  const FlipFilters filters = make_flip_filters(settings.pixels_per_degree);
  const int columns = (pair.width() + tile_width - 1) / tile_width;
  const int rows = (pair.height() + tile_height - 1) / tile_height;
  for_each_part(columns * rows, [&](int i) {
    const int x0 = i % columns * tile_width, y0 = i / columns * tile_height;
    const Tile tile = {x0, y0, std::min(x0 + tile_width, pair.width()), std::min(y0 + tile_height, pair.height())};
    TileWork work(pair, filters);
    for (int k = 0; k < exposures.count; ++k) work.raise(tile, exposures.stops(k), flip.map);
  });
  mark_non_finite(pair, flip.map);
  return flip;
}

}  // namespace candil
