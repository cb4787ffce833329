#include "core/tonemap_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace candil {
namespace {

void measure_means(const Image& image, ImageStatistics& statistics) {
  double count = 0;
  for_each_color(image, [&](DVec3 color) {
    count += 1;
    statistics.mean_color += color;
    statistics.maximum = std::max({statistics.maximum, color.x, color.y, color.z});
  });
  if (count > 0) statistics.mean_color /= count;
  statistics.mean_luminance = precise_luminance(statistics.mean_color);
}

/// Needs the mean.
void measure_lit_pixels(const Image& image, ImageStatistics& statistics) {
  const double darkest = 1e-9 * statistics.mean_luminance;
  double count = 0, sum = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for_each_color(image, [&](DVec3 color) {
    const double luminance = precise_luminance(color);
    if (!(luminance > darkest)) return;
    count += 1;
    sum += std::log(luminance);
    lowest = std::min(lowest, luminance);
    statistics.highest_luminance = std::max(statistics.highest_luminance, luminance);
  });
  if (count == 0) return;
  statistics.lowest_luminance = lowest;
  statistics.log_average = std::exp(sum / count);
}

}  // namespace

ImageStatistics measure_image(const Image& linear) {
  ImageStatistics statistics;
  measure_means(linear, statistics);
  measure_lit_pixels(linear, statistics);
  return statistics;
}

double precise_luminance(DVec3 color) { return glm::dot(color, DVec3(0.2126, 0.7152, 0.0722)); }

DVec3 straight_color(const float* pixel, int channels) {
  const DVec3 color(pixel[0], pixel[1], pixel[2]);
  return channels == 4 && pixel[3] > 0 ? color / static_cast<double>(pixel[3]) : color;
}

DVec3 usable_light(DVec3 color) {
  for (int i = 0; i < 3; ++i) {
    if (!(color[i] > 0)) color[i] = 0;
    if (std::isinf(color[i])) color[i] = std::numeric_limits<float>::max();
  }
  return color;
}

bool has_finite_color(const float* pixel) {
  return std::isfinite(pixel[0]) && std::isfinite(pixel[1]) && std::isfinite(pixel[2]);
}

}  // namespace candil
