#include "metrics/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace candil {
namespace {

/// Table 1 of the paper: weight a and width b of a Gaussian a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct Contrast {
  double a, b;

  double sigma() const { return std::sqrt(b / 2) / std::numbers::pi; }  // degrees
  double height() const { return a * std::sqrt(std::numbers::pi / b); }
};
constexpr Contrast luminance = {1, 0.0047}, red_green = {1, 0.0053};
constexpr Contrast blue_yellow_wide = {34.1, 0.04}, blue_yellow_narrow = {13.5, 0.025};

/// Width of the feature detectors, degrees.
constexpr double feature_width = 0.082;

/// The paper cuts all filters where the widest one has come down to three sigma; beyond 4.5 sigma of their own there is
/// nothing left of the narrow ones (7e-6).
HalfKernel contrast_kernel(const Contrast& contrast, double pixels_per_degree, int largest_radius) {
  const double sigma = contrast.sigma() * pixels_per_degree;
  return gaussian_kernel(sigma, std::min(largest_radius, static_cast<int>(std::ceil(4.5 * sigma))));
}

HalfKernel scaled(HalfKernel kernel, double factor) {
  for (float& weight : kernel.weights) weight = static_cast<float>(weight * factor);
  return kernel;
}

/// Sum of exp(-x^2 / (2 sigma^2)) over the pixels of the filter: what normalisation divided by.
double gaussian_sum(double sigma, int radius) {
  double sum = 1;
  for (int k = 1; k <= radius; ++k) sum += 2 * std::exp(-k * k / (2 * sigma * sigma));
  return sum;
}

/// Share of one of the two Gaussians in the normalised sum, two-dimensional.
double share(const Contrast& one, const Contrast& other, double pixels_per_degree, int radius) {
  const auto volume = [&](const Contrast& contrast) {
    const double sum = gaussian_sum(contrast.sigma() * pixels_per_degree, radius);
    return contrast.height() * sum * sum;
  };
  return volume(one) / (volume(one) + volume(other));
}

/// Weights of both halves are scaled so that the positive ones sum up to 1, and the negative ones to -1.
HalfKernel balanced(const std::vector<double>& weights, bool is_symmetric) {
  double positive = 0, negative = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    // The half that is not stored mirrors a symmetric kernel; in an antisymmetric one it has the other sign.
    const double copies = is_symmetric && k > 0 ? 2 : 1;
    (weights[k] > 0 ? positive : negative) += copies * std::abs(weights[k]);
  }
  HalfKernel kernel;
  kernel.is_symmetric = is_symmetric;
  for (const double weight : weights)
    kernel.weights.push_back(static_cast<float>(weight / (weight > 0 || negative == 0 ? positive : negative)));
  return kernel;
}

}  // namespace

FlipFilters make_flip_filters(double pixels_per_degree) {
  FlipFilters filters;
  const int radius = static_cast<int>(std::ceil(3 * blue_yellow_wide.sigma() * pixels_per_degree));
  filters.luminance = contrast_kernel(luminance, pixels_per_degree, radius);
  filters.red_green = contrast_kernel(red_green, pixels_per_degree, radius);
  filters.blue_yellow_wide = contrast_kernel(blue_yellow_wide, pixels_per_degree, radius);
  filters.blue_yellow_narrow = contrast_kernel(blue_yellow_narrow, pixels_per_degree, radius);
  const double wide_share = share(blue_yellow_wide, blue_yellow_narrow, pixels_per_degree, radius);
  filters.blue_yellow_wide_along = scaled(filters.blue_yellow_wide, wide_share);
  filters.blue_yellow_narrow_along = scaled(filters.blue_yellow_narrow, 1 - wide_share);

  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int feature_radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<double> edge, point;
  for (int k = 0; k <= feature_radius; ++k) {
    const double squares = k * k / (sigma * sigma), height = std::exp(-squares / 2);
    edge.push_back(k * height);
    point.push_back((squares - 1) * height);
  }
  filters.smooth = gaussian_kernel(sigma, feature_radius);
  filters.edge = balanced(edge, false);
  filters.point = balanced(point, true);
  filters.radius = std::max(radius, feature_radius);
  return filters;
}

}  // namespace candil
