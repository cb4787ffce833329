#include "core/environment.h"

#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "core/warp.h"

namespace candil {
namespace {

/// Bilinear lookup that repeats around the horizon and stops at the poles.
Vec3 lookup(const Image& image, Vec2 uv) {
  const float x = uv.x * static_cast<float>(image.width) - 0.5f, y = uv.y * static_cast<float>(image.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const float fx = x - left, fy = y - top;
  const auto texel = [&](int column, int row) {
    column = column < 0 ? column + image.width : column >= image.width ? column - image.width : column;
    const float* p = image.pixel(column, std::clamp(row, 0, image.height - 1));
    return Vec3(p[0], p[1], p[2]);
  };
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  return glm::mix(glm::mix(texel(column, row), texel(column + 1, row), fx),
                  glm::mix(texel(column, row + 1), texel(column + 1, row + 1), fx), fy);
}

/// Weight of every texel: mean luminance of the bilinear image over the texel's square times the texel's solid angle.
/// The mean is a 3 x 3 stencil (1/8, 3/4, 1/8 each way), which is positive wherever the interpolated image is.
std::vector<float> sampling_weights(const Image& image) {
  const int width = image.width, height = image.height;
  const auto stencil = [](float before, float here, float after) { return 0.125f * (before + after) + 0.75f * here; };
  std::vector<float> rows(static_cast<std::size_t>(width) * height), weights(rows.size());
  const auto value = [&](int x, int y) {
    const float* p = image.pixel((x + width) % width, y);
    return luminance({p[0], p[1], p[2]});
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      rows[static_cast<std::size_t>(y) * width + x] = stencil(value(x - 1, y), value(x, y), value(x + 1, y));
    }
  }
  for (int y = 0; y < height; ++y) {
    const float sin_theta = std::sin(pi * (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
    const std::size_t above = static_cast<std::size_t>(std::max(y - 1, 0)) * width;
    const std::size_t here = static_cast<std::size_t>(y) * width;
    const std::size_t below = static_cast<std::size_t>(std::min(y + 1, height - 1)) * width;
    for (int x = 0; x < width; ++x) {
      weights[here + x] = sin_theta * stencil(rows[above + x], rows[here + x], rows[below + x]);
    }
  }
  return weights;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : environment_(environment),
      cos_rotation_(std::cos(environment.rotation)),
      sin_rotation_(std::sin(environment.rotation)) {
  if (!is_present()) return;
  mean_luminance_ = luminance(environment.tint);
  const Image& image = environment.image;
  if (image.empty()) return;
  const std::vector<float> weights = sampling_weights(image);
  distribution_ = Distribution2D(weights, image.width, image.height);
  double sum = 0;
  for (const float w : weights) sum += w;
  // Weights hold sin(theta); its mean over the rows is 2 / pi.
  mean_luminance_ *= static_cast<float>(sum / static_cast<double>(weights.size())) * pi / 2;
}

Vec2 EnvironmentLight::to_uv(Vec3 d) const {
  // Into the image's own frame: turned back by the rotation about +Y.
  const float x = cos_rotation_ * d.x - sin_rotation_ * d.z, z = sin_rotation_ * d.x + cos_rotation_ * d.z;
  const float u = 0.5f + std::atan2(x, -z) / (2 * pi);
  return {glm::min(u, one_minus_epsilon), std::acos(glm::clamp(d.y, -1.0f, 1.0f)) / pi};
}

Vec3 EnvironmentLight::from_uv(Vec2 uv) const {
  const float phi = 2 * pi * (uv.x - 0.5f), theta = pi * uv.y;
  const float x = std::sin(theta) * std::sin(phi), z = -std::sin(theta) * std::cos(phi);
  return {cos_rotation_ * x + sin_rotation_ * z, std::cos(theta), -sin_rotation_ * x + cos_rotation_ * z};
}

Vec3 EnvironmentLight::radiance(Vec3 direction) const {
  if (environment_.image.empty()) return environment_.tint;
  return environment_.tint * lookup(environment_.image, to_uv(direction));
}

EnvironmentLight::Sample EnvironmentLight::sample(Vec2 u) const {
  if (distribution_.is_empty()) return {sample_sphere(u), environment_.tint, pdf_sphere};
  const Distribution2D::Sample sampled = distribution_.sample(u);
  const float sin_theta = std::sin(pi * sampled.point.y);
  // d(solid angle) = 2 pi^2 sin(theta) du dv
  const float pdf = sin_theta > 0 ? sampled.pdf / (2 * pi * pi * sin_theta) : 0;
  return {from_uv(sampled.point), environment_.tint * lookup(environment_.image, sampled.point), pdf};
}

float EnvironmentLight::pdf(Vec3 direction) const {
  if (distribution_.is_empty()) return pdf_sphere;
  const float sin_theta = glm::length(Vec2(direction.x, direction.z));  // exact near the poles too
  return sin_theta > 0 ? distribution_.pdf(to_uv(direction)) / (2 * pi * pi * sin_theta) : 0;
}

}  // namespace candil
