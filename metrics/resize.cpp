#include "metrics/resize.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "metrics/parallel_rows.h"

namespace candil {
namespace {

/// The pixels that one new pixel is made of, along one direction.
struct Taps {
  int first = 0;
  std::vector<float> weights;
};

std::vector<Taps> make_taps(int from, int to) {
  const double scale = static_cast<double>(from) / to, radius = std::max(1.0, scale);
  std::vector<Taps> all;
  for (int i = 0; i < to; ++i) {
    const double center = (i + 0.5) * scale - 0.5;
    Taps taps;
    taps.first = std::clamp(static_cast<int>(std::ceil(center - radius)), 0, from - 1);
    const int last = std::clamp(static_cast<int>(std::floor(center + radius)), taps.first, from - 1);
    double sum = 0;
    for (int k = taps.first; k <= last; ++k) sum += std::max(1 - std::abs(k - center) / radius, 1e-9);
    for (int k = taps.first; k <= last; ++k)
      taps.weights.push_back(static_cast<float>(std::max(1 - std::abs(k - center) / radius, 1e-9) / sum));
    all.push_back(std::move(taps));
  }
  return all;
}

}  // namespace

Image resize_image(const Image& image, int width, int height) {
  const std::vector<Taps> across = make_taps(image.width, width), down = make_taps(image.height, height);
  const int channels = image.channels;
  Image narrow(width, image.height, channels);
  for_each_row(image.height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const Taps& taps = across[static_cast<std::size_t>(x)];
      float* const out = narrow.pixel(x, y);
      for (std::size_t k = 0; k < taps.weights.size(); ++k) {
        const float* const in = image.pixel(taps.first + static_cast<int>(k), y);
        for (int c = 0; c < channels; ++c) out[c] += taps.weights[k] * in[c];
      }
    }
  });
  Image result(width, height, channels);
  for_each_row(height, [&](int y) {
    const Taps& taps = down[static_cast<std::size_t>(y)];
    float* const out = result.pixel(0, y);
    for (std::size_t k = 0; k < taps.weights.size(); ++k) {
      const float* const in = narrow.pixel(0, taps.first + static_cast<int>(k));
      for (int i = 0; i < width * channels; ++i) out[i] += taps.weights[k] * in[i];
    }
  });
  return result;
}

}  // namespace candil
