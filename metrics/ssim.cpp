#include "metrics/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "metrics/fast_math.h"
#include "metrics/parallel_rows.h"
#include "metrics/row_filter.h"

namespace candil {
namespace {

constexpr int radius = 5;
constexpr double sigma = 1.5;

/// Values outside of [0, 1] are cut; NaN is 0.
float unit(float v) { return v > 0 ? (v < 1 ? v : 1.0f) : 0.0f; }

float encode(float linear) {
  const float curve = 1.055f * fast_pow(linear, 1 / 2.4f) - 0.055f;
  return linear <= 0.0031308f ? 12.92f * linear : curve;
}

/// Rows of luma with room for the window on both sides, filled with zeros.
class Luma {
 public:
  Luma(const Image& image, ValueKind kind)
      : stride_(image.width + 2 * radius), values_(static_cast<std::size_t>(stride_) * image.height) {
    for_each_row(image.height, [&](int y) {
      const float* const pixels = image.pixel(0, y);
      const int channels = image.channels;
      float* const out = row(y) + radius;
      constexpr std::array<float, 3> weights = {0.2126f, 0.7152f, 0.0722f};
      for (int c = 0; c < 3; ++c) {
        const float weight = weights[static_cast<std::size_t>(c)];
        if (kind == ValueKind::linear)
          for (int x = 0; x < image.width; ++x) out[x] += weight * encode(unit(pixels[x * channels + c]));
        else
          for (int x = 0; x < image.width; ++x) out[x] += weight * unit(pixels[x * channels + c]);
      }
    });
  }

  int stride() const { return stride_; }
  const float* row(int y) const { return &values_[static_cast<std::size_t>(y) * stride_]; }

 private:
  float* row(int y) { return &values_[static_cast<std::size_t>(y) * stride_]; }

  int stride_;
  std::vector<float> values_;
};

/// Weighted sums of a, b, a^2, b^2 and ab.
using Moments = std::array<std::vector<float>, 5>;

void add_row(Moments& moments, float weight, const float* __restrict a, const float* __restrict b, int count) {
  float* const __restrict sum_a = moments[0].data();
  float* const __restrict sum_b = moments[1].data();
  float* const __restrict sum_aa = moments[2].data();
  float* const __restrict sum_bb = moments[3].data();
  float* const __restrict sum_ab = moments[4].data();
  for (int i = 0; i < count; ++i) {
    sum_a[i] += weight * a[i];
    sum_b[i] += weight * b[i];
    sum_aa[i] += weight * (a[i] * a[i]);
    sum_bb[i] += weight * (b[i] * b[i]);
    sum_ab[i] += weight * (a[i] * b[i]);
  }
}

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
  const float* const aa = moments[2].data();
  const float* const bb = moments[3].data();
  const float* const ab = moments[4].data();
  for (std::size_t x = 0; x < scale.size(); ++x) {
    const float s = scale[x] * row_scale, mean_a = a[x] * s, mean_b = b[x] * s;
    const float squares = mean_a * mean_a + mean_b * mean_b, product = mean_a * mean_b;
    const float variances = (aa[x] * s - mean_a * mean_a) + (bb[x] * s - mean_b * mean_b);
    const float covariance = ab[x] * s - product;
    out[x] = (2 * product + c1) * (2 * covariance + c2) / ((squares + c1) * (variances + c2));
  }
}

void mark_non_finite(const ImagePair& pair, int y, float* out) {
  const int channels = pair.a.channels;
  const float *a = pair.a.pixel(0, y), *b = pair.b.pixel(0, y);
  for (int x = 0; x < pair.width(); ++x)
    for (int c = 0; c < 3; ++c)
      if (std::abs(difference(a[x * channels + c], b[x * channels + c])) == infinity) out[x] = 0;
}

}  // namespace

Image measure_ssim(const ImagePair& pair) {
  const Luma a(pair.a, pair.kind), b(pair.b, pair.kind);
  const HalfKernel kernel = gaussian_kernel(sigma, radius);
  std::vector<float> scale = weight_sums(kernel, pair.width());
  for (float& weight : scale) weight = 1 / weight;
  const std::vector<float> row_weights = weight_sums(kernel, pair.height());
  Image map(pair.width(), pair.height(), 1);
  for_each_row(pair.height(), [&](int y) {
    Moments across, sums;
    for (std::vector<float>& row : across) row.assign(static_cast<std::size_t>(a.stride()), 0.0f);
    for (std::vector<float>& row : sums) row.resize(static_cast<std::size_t>(pair.width()));
    for (int k = std::max(-radius, -y); k <= std::min(radius, pair.height() - 1 - y); ++k)
      add_row(across, kernel.weights[static_cast<std::size_t>(std::abs(k))], a.row(y + k), b.row(y + k), a.stride());
    for (std::size_t i = 0; i < sums.size(); ++i)
      filter_along_row(kernel, across[i].data() + radius, sums[i].data(), pair.width());
    indices(sums, scale, 1 / row_weights[static_cast<std::size_t>(y)], map.pixel(0, y));
    mark_non_finite(pair, y, map.pixel(0, y));
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
