#include "core/pixel_filter.h"

#include <cmath>
#include <vector>

namespace candil {
namespace {

constexpr float radius = 1.5f;

/// Blackman-Harris window, four terms (Harris 1978), over [-radius, radius].
float blackman_harris(float x) {
  const float phase = pi * (x / radius + 1);
  return 0.35875f - 0.48829f * std::cos(phase) + 0.14128f * std::cos(2 * phase) - 0.01168f * std::cos(3 * phase);
}

float gaussian(float x) {
  constexpr float deviation = 0.5f;
  return std::exp(-0.5f * sqr(x / deviation));
}

}  // namespace

std::optional<FilterKind> filter_from_name(std::string_view name) {
  if (name == "box") return FilterKind::box;
  if (name == "blackman-harris") return FilterKind::blackman_harris;
  if (name == "gaussian") return FilterKind::gaussian;
  return std::nullopt;
}

PixelFilter::PixelFilter(FilterKind kind) {
  if (kind == FilterKind::box) {
    for (int i = 0; i <= table_size; ++i) inverse_cdf_[i] = static_cast<float>(i) / table_size - 0.5f;
    return;
  }
  // Midpoint rule on a grid much finer than the table, then inverted by walking along it.
  constexpr int steps = 1 << 15;
  constexpr float step = 2 * radius / steps;
  std::vector<double> cdf(steps + 1);
  for (int i = 0; i < steps; ++i) {
    const float x = -radius + (static_cast<float>(i) + 0.5f) * step;
    cdf[i + 1] = cdf[i] + (kind == FilterKind::gaussian ? gaussian(x) : blackman_harris(x));
  }
  int cell = 0;
  for (int i = 0; i <= table_size; ++i) {
    const double target = cdf[steps] * i / table_size;
    while (cell < steps - 1 && cdf[cell + 1] < target) ++cell;
    const double within = (target - cdf[cell]) / (cdf[cell + 1] - cdf[cell]);
    inverse_cdf_[i] = -radius + static_cast<float>(cell + within) * step;
  }
}

}  // namespace candil
