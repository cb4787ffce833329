#include "metrics/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "metrics/fast_math.h"
#include "metrics/filter_block.h"
#include "metrics/parallel_rows.h"
#include "metrics/pixel_rows.h"
#include "metrics/row_filter.h"

namespace candil {
namespace {

constexpr int radius = 5;
constexpr double sigma = 1.5;

/// Values outside of [0, 1] are cut; NaN is 0.
[[gnu::always_inline]] inline float unit(float v) { return v > 0 ? (v < 1 ? v : 1.0f) : 0.0f; }

[[gnu::always_inline]] inline float encode(float linear) {
  const float curve = 1.055f * fast_pow(linear, 1 / 2.4f) - 0.055f;
  return linear <= 0.0031308f ? 12.92f * linear : curve;
}

/// What lumas are measured from: variances do not care, and squares of smaller numbers cancel better.
constexpr float middle = 0.5f;

/// From the middle.
void write_luma(const Image& image, ValueKind kind, int y, const std::array<float*, 3>& colors, float* __restrict out) {
  split_colors(image.pixel(0, y), image.channels, image.width, colors);
  const float* const red = colors[0];
  const float* const green = colors[1];
  const float* const blue = colors[2];
  const auto luma = [](float r, float g, float b) {
    return multiply_add(0.2126f, r, multiply_add(0.7152f, g, multiply_add(0.0722f, b, -middle)));
  };
  if (kind == ValueKind::linear)
    for (int x = 0; x < image.width; ++x)
      out[x] = luma(encode(unit(red[x])), encode(unit(green[x])), encode(unit(blue[x])));
  else
    for (int x = 0; x < image.width; ++x) out[x] = luma(unit(red[x]), unit(green[x]), unit(blue[x]));
}

/// Weighted sums of a, b, a^2 + b^2 and ab, all from the middle.
using Moments = std::array<std::vector<float>, 4>;

/// Rows that are filtered together.
constexpr int batch = 4;

/// What is summed up, for the rows around those under way. Beyond the image there are zeros.
class Window {
 public:
  explicit Window(const ImagePair& pair)
      : pair_(pair), stride_((pair.width() + 2 * radius + filter_lanes - 1) / filter_lanes * filter_lanes) {
    const auto wide = static_cast<std::size_t>(stride_);
    for (std::vector<float>& row : colors_) row.resize(static_cast<std::size_t>(pair.width()));
    for (std::vector<float>& plane : planes_) plane.resize(wide * span);
    for (std::vector<float>& rows : across_) rows.resize(wide * batch);
    for (std::vector<float>& row : sums_) row.resize(static_cast<std::size_t>(pair.width()));
  }

  void push_row(int y) {
    const int width = pair_.width();
    std::array<float*, 4> rows;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = row(i, y) + radius;
    if (y < 0 || y >= pair_.height()) {
      for (float* const values : rows) std::fill_n(values, width, 0.0f);
      return;
    }
    const std::array<float*, 3> colors = {colors_[0].data(), colors_[1].data(), colors_[2].data()};
    write_luma(pair_.a, pair_.kind, y, colors, rows[0]);
    write_luma(pair_.b, pair_.kind, y, colors, rows[1]);
    multiply(rows[0], rows[1], rows[2], rows[3], width);
  }

  /// The rows of a batch from y on; those up to the radius around them have been pushed.
  void filter_across(const std::vector<float>& whole_kernel, int y) {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      std::array<const float*, span> rows;
      for (int k = 0; k < span; ++k) rows[static_cast<std::size_t>(k)] = row(i, y + k - radius);
      for (int x = 0; x < stride_; x += filter_lanes) {
        BatchSums<batch, 1, 1> sums;
        sums.add({whole_kernel.data()}, radius, rows.data(), x);
        sums.store(0, across_[i].data(), static_cast<std::size_t>(stride_), x);
      }
    }
  }

  /// Row `place` of the batch.
  const Moments& filter_along(const HalfKernel& kernel, int place) {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const std::size_t start = static_cast<std::size_t>(place) * static_cast<std::size_t>(stride_) + radius;
      filter_along_row(kernel, across_[i].data() + start, sums_[i].data(), pair_.width());
    }
    return sums_;
  }

 private:
  static constexpr int span = 2 * radius + batch;

  static void multiply(const float* __restrict a, const float* __restrict b, float* __restrict squares,
                       float* __restrict products, int width) {
    for (int x = 0; x < width; ++x) squares[x] = a[x] * a[x] + b[x] * b[x], products[x] = a[x] * b[x];
  }

  float* row(std::size_t plane, int y) {
    const int slot = (y + span) % span;  // y is -radius at the least
    return &planes_[plane][static_cast<std::size_t>(slot) * static_cast<std::size_t>(stride_)];
  }

  const ImagePair& pair_;
  int stride_;
  std::array<std::vector<float>, 3> colors_;
  Moments planes_;  // row y in slot y mod span
  Moments across_;  // of a batch
  Moments sums_;
};

/// What is left of the window's weights around each place of `count`.
std::vector<float> weight_sums(const HalfKernel& kernel, int count) {
  std::vector<float> sums;
  for (int i = 0; i < count; ++i) {
    float sum = 0;
    for (int k = -radius; k <= radius; ++k)
      if (i + k >= 0 && i + k < count) sum += kernel.weights[static_cast<std::size_t>(std::abs(k))];
    sums.push_back(sum);
  }
  return sums;
}

/// Equation 13 of the paper, from the sums over the window; `scale[x] * row_scale` makes them means.
void indices(const Moments& moments, const std::vector<float>& scale, float row_scale, float* __restrict out) {
  constexpr float c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
  const float* const a = moments[0].data();
  const float* const b = moments[1].data();
  const float* const both = moments[2].data();
  const float* const ab = moments[3].data();
  for (std::size_t x = 0; x < scale.size(); ++x) {
    const float s = scale[x] * row_scale, from_a = a[x] * s, from_b = b[x] * s;
    const float variances = both[x] * s - (from_a * from_a + from_b * from_b);
    const float covariance = ab[x] * s - from_a * from_b;
    const float mean_a = from_a + middle, mean_b = from_b + middle;
    const float squares = mean_a * mean_a + mean_b * mean_b, product = mean_a * mean_b;
    out[x] = (2 * product + c1) * (2 * covariance + c2) / ((squares + c1) * (variances + c2));
  }
}

void mark_non_finite(const ImagePair& pair, int y, float* out) {
  const int channels = pair.a.channels;
  const float *a = pair.a.pixel(0, y), *b = pair.b.pixel(0, y);
  const auto count = static_cast<std::size_t>(pair.width()) * static_cast<std::size_t>(channels);
  if (is_finite_row(a, count) && is_finite_row(b, count)) return;
  for (int x = 0; x < pair.width(); ++x)
    for (int c = 0; c < 3; ++c)
      if (std::abs(difference(a[x * channels + c], b[x * channels + c])) == infinity) out[x] = 0;
}

}  // namespace

Image measure_ssim(const ImagePair& pair) {
  const HalfKernel kernel = gaussian_kernel(sigma, radius);
  std::vector<float> scale = weight_sums(kernel, pair.width());
  for (float& weight : scale) weight = 1 / weight;
  const std::vector<float> row_weights = weight_sums(kernel, pair.height());
  Image map(pair.width(), pair.height(), 1);
  const std::vector<float> whole = whole_kernel(kernel);
  // Bands of rows, each on one core; what lies around them is made anew for each.
  constexpr int band = 72;
  for_each_part((pair.height() + band - 1) / band, [&](int i) {
    Window window(pair);
    const int first = i * band, last = std::min(first + band, pair.height());
    int next = first - radius;
    for (int start = first; start < last; start += batch) {
      for (; next < start + batch + radius; ++next) window.push_row(next);
      window.filter_across(whole, start);
      for (int y = start; y < std::min(start + batch, last); ++y) {
        float* const out = map.pixel(0, y);
        indices(window.filter_along(kernel, y - start), scale, 1 / row_weights[static_cast<std::size_t>(y)], out);
        mark_non_finite(pair, y, out);
      }
    }
  });
  return map;
}

PixelSelection ssim_selection(const PixelSelection& selection) {
  const int width = selection.width() - 2 * radius, height = selection.height() - 2 * radius;
  if (width < 1 || height < 1) return selection;
  PixelSelection inner = selection;
  inner.keep(std::vector<Region>{{radius, radius, width, height}});
  return inner.count() > 0 ? inner : selection;
}

}  // namespace candil
