#include "core/film.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"

namespace candil {

std::uint32_t next_block_size(std::uint32_t samples_done, std::uint32_t samples_wanted) {
  constexpr std::uint32_t largest = 16;
  const std::uint32_t remaining = samples_wanted - samples_done;
  std::uint32_t size = samples_done == 0 ? 1 : std::min(largest, samples_done & ~(samples_done - 1));
  while (size > remaining) size /= 2;
  return size;
}

Film::Film(int width, int height)
    : width_(width), height_(height), sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

Image Film::mean() const {
  Image image(width_, height_, 4);
  const float scale = sample_count() > 0 ? 1 / static_cast<float>(sample_count()) : 0;
  for (std::size_t i = 0; i < image.pixels.size() / 4; ++i) {
    const PixelSums sum = sums_.total(i);
    for (int c = 0; c < 3; ++c) image.pixels[4 * i + c] = sum.radiance[c] * scale;
    image.pixels[4 * i + 3] = std::min(sum.alpha * scale, 1.0f);
  }
  return image;
}

Image Film::variance() const {
  Image image(width_, height_, 3);
  if (sample_count() < 2) return image;
  const auto n = static_cast<float>(sample_count());
  for (std::size_t i = 0; i < image.pixels.size() / 3; ++i) {
    const PixelSums sum = sums_.total(i);
    for (int c = 0; c < 3; ++c) {
      const float spread = sum.radiance_squared[c] - sqr(sum.radiance[c]) / n;
      image.pixels[3 * i + c] = std::max(spread, 0.0f) / (n * (n - 1));
    }
  }
  return image;
}

float Film::relative_noise() const {
  if (sample_count() < 2) return 0;
  const Image values = mean(), variances = variance();
  double luminances = 0, squares = 0;
  const std::size_t count = variances.pixels.size() / 3;
  for (std::size_t i = 0; i < count; ++i) {
    const float* v = &variances.pixels[3 * i];
    const float* m = &values.pixels[4 * i];
    luminances += luminance({m[0], m[1], m[2]});
    // The channels of a sample rise and fall together: their deviations add up, not their variances.
    squares += sqr(luminance({std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2])}));
  }
  const double mean_luminance = luminances / static_cast<double>(count);
  return mean_luminance > 0 ? static_cast<float>(std::sqrt(squares / static_cast<double>(count)) / mean_luminance) : 0;
}

}  // namespace candil
