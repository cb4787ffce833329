/// Pairs of images that a renderer could have made: means of samples of one and the same distribution.
#pragma once

#include <cstdint>
#include <functional>
#include <random>

#include "metrics/z_test.h"

namespace candil::test {

/// A mean with the variance that is estimated from its samples, as Film gives it.
struct NoisyImage {
  Image mean, variance;
  std::uint32_t samples;

  ImageVariance noise() const { return {variance, samples}; }
};

/// One sample of a pixel's channel.
using DrawSample = std::function<double(std::mt19937& generator, int x, int y)>;

inline NoisyImage make_noisy_image(int width, int height, std::uint32_t samples, std::uint32_t seed,
                                   const DrawSample& draw) {
  NoisyImage image{Image(width, height, 3), Image(width, height, 3), samples};
  std::mt19937 generator(seed);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
          const double sample = draw(generator, x, y);
          sum += sample, squares += sample * sample;
        }
        const double n = samples, spread = squares - sum * sum / n;
        image.mean.pixel(x, y)[c] = static_cast<float>(sum / n);
        image.variance.pixel(x, y)[c] = static_cast<float>(spread > 0 ? spread / (n * (n - 1)) : 0);
      }
  return image;
}

inline ZTest test_images(const NoisyImage& a, const NoisyImage& b, const ZTestSettings& settings = {}) {
  return measure_z_test({a.mean, b.mean, ValueKind::linear}, a.noise(), b.noise(),
                        PixelSelection(a.mean.width, a.mean.height), settings);
}

}  // namespace candil::test
