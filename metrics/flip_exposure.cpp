#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/flip.h"
#include "metrics/flip_tone.h"
#include "metrics/map_statistics.h"
#include "metrics/parallel_rows.h"

namespace candil {
namespace {

/// How bright the brightest and the median pixel are to be shown.
constexpr double shown = 0.85;

/// The value that the ACES curve takes to `shown`: the positive root of a quadratic equation.
double value_shown() {
  const double a = aces[0] - shown * aces[2], b = aces[1] - shown * aces[3], c = -shown * aces[4];
  return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

Image luminances(const Image& image) {
  Image map(image.width, image.height, 1);
  for_each_row(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const p = image.pixel(x, y);
      const float value = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
      *map.pixel(x, y) = std::isfinite(value) ? value : 0;
    }
  });
  return map;
}

}  // namespace

FlipExposures flip_exposures(const Image& reference) {
  const Image map = luminances(reference);
  const PixelSelection all(map.width, map.height);
  const std::size_t ranks[] = {all.count() / 2, all.count() - 1};
  const std::vector<float> values = map_order_statistics(map, all, ranks);
  constexpr float least = std::numeric_limits<float>::epsilon();
  const double median = std::max(values[0], least), brightest = std::max(values[1], least);
  FlipExposures exposures;
  exposures.start = static_cast<float>(std::log2(value_shown() / brightest));
  exposures.stop = static_cast<float>(std::log2(value_shown() / median));
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

}  // namespace candil
