#include "core/tonemap_reinhard.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace candil {
namespace {

double choose_contrast(const ImageStatistics& statistics) {
  if (!(statistics.highest_luminance > statistics.lowest_luminance)) return 0.3 + 0.7 * std::pow(0.5, 1.4);
  const double top = std::log(statistics.highest_luminance);
  const double range = top - std::log(statistics.lowest_luminance);
  const double key = std::clamp((top - std::log(statistics.log_average)) / range, 0.0, 1.0);
  return 0.3 + 0.7 * std::pow(key, 1.4);
}

DVec3 response(const Photoreceptor& receptor, DVec3 color) {
  const Tonemap& tonemap = receptor.tonemap;
  const DVec3 local = glm::mix(DVec3(precise_luminance(color)), color, tonemap.color);
  const DVec3 global =
      glm::mix(DVec3(receptor.statistics.mean_luminance), receptor.statistics.mean_color, tonemap.color);
  const DVec3 adaptation = std::exp(-tonemap.intensity) * glm::mix(global, local, tonemap.light);
  DVec3 shown(0);
  for (int i = 0; i < 3; ++i)
    if (color[i] > 0) shown[i] = color[i] / (color[i] + std::pow(adaptation[i], receptor.contrast));
  return shown;
}

}  // namespace

DVec3 reinhard02_tonemap(const Tonemap& tonemap, const ImageStatistics& statistics, DVec3 color) {
  const double luminance = precise_luminance(color);
  if (!(luminance > 0) || !(statistics.log_average > 0)) return DVec3(0);
  const double scale = tonemap.key / statistics.log_average;
  const double scaled = scale * luminance;
  const double white = tonemap.white > 0 ? tonemap.white : scale * statistics.highest_luminance;
  constexpr double beyond_any_display = 1e30;  // keeps a white point of nearly 0 from making infinity
  const double shown = std::min((scaled + scaled / white * (scaled / white)) / (1 + scaled), beyond_any_display);
  return color * (shown / luminance);
}

Photoreceptor make_photoreceptor(const Tonemap& tonemap, const ImageStatistics& statistics, const Image& linear) {
  Photoreceptor receptor{tonemap, statistics};
  receptor.contrast = tonemap.contrast > 0 ? tonemap.contrast : choose_contrast(statistics);
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for_each_color(linear, [&](DVec3 color) {
    const DVec3 shown = response(receptor, color);
    low = std::min({low, shown.x, shown.y, shown.z});
    high = std::max({high, shown.x, shown.y, shown.z});
  });
  if (high > low) receptor.low = low, receptor.high = high;
  return receptor;
}

DVec3 reinhard05_tonemap(const Photoreceptor& receptor, DVec3 color) {
  return (response(receptor, color) - receptor.low) / (receptor.high - receptor.low);
}

}  // namespace candil
