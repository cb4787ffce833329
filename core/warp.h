/// Maps of the unit square to the domains that are sampled, each with its density.
#pragma once

#include <cmath>

#include "core/math.h"

namespace candil {

/// Sine and cosine of an angle in [-pi/4, pi/4] by Taylor's series: correct to 4e-7, and several times as fast as the
/// general functions.
inline Vec2 sine_cosine_of_octant(float x) {
  const float x2 = x * x;
  return {x * (1 + x2 * (-1 / 6.0f + x2 * (1 / 120.0f + x2 * (-1 / 5040.0f)))),
          1 + x2 * (-0.5f + x2 * (1 / 24.0f + x2 * (-1 / 720.0f + x2 * (1 / 40320.0f))))};
}

/// Unit disc, uniform (density 1/pi); keeps neighbours neighbours (Shirley and Chiu 1997).
inline Vec2 sample_disc(Vec2 u) {
  const Vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0 && p.y == 0) return Vec2(0);
  const bool is_x_larger = std::abs(p.x) > std::abs(p.y);
  const float radius = is_x_larger ? p.x : p.y, other = is_x_larger ? p.y : p.x;
  const Vec2 direction = sine_cosine_of_octant(pi / 4 * (other / radius));
  return radius * (is_x_larger ? Vec2(direction.y, direction.x) : direction);
}

/// Regular polygon with its corners on the unit circle, the first at (1, 0), uniform: density 2 / (n sin(2 pi / n)) for
/// n corners, at least 3. The sector of the disc between two corners becomes the triangle between them, circles
/// becoming polygons: as continuous as sample_disc().
inline Vec2 sample_regular_polygon(Vec2 u, int corners) {
  const Vec2 disc = sample_disc(u);
  const float step = 2 * pi / static_cast<float>(corners);
  const float sectors = std::atan2(disc.y, disc.x) / step, sector = std::floor(sectors);
  const auto corner = [&](float i) { return Vec2(std::cos(i * step), std::sin(i * step)); };
  return glm::length(disc) * glm::mix(corner(sector), corner(sector + 1), sectors - sector);
}

/// Hemisphere around +Z, density cos(theta) / pi per steradian.
inline Vec3 sample_cosine_hemisphere(Vec2 u) {
  const Vec2 d = sample_disc(u);
  return {d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
}
inline float pdf_cosine_hemisphere(float cos_theta) { return glm::max(0.0f, cos_theta) * (1 / pi); }

/// Sphere, uniform: density 1/(4 pi) per steradian.
inline Vec3 sample_sphere(Vec2 u) {
  const float z = 1 - 2 * u.x;
  const float radius = safe_sqrt(1 - z * z), angle = 2 * pi * u.y;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}
inline constexpr float pdf_sphere = 1 / (4 * pi);

/// Barycentric weights of the second and third vertex, uniform over a triangle's area (Heitz 2019, "A Low-Distortion
/// Map Between Triangle and Square").
inline Vec2 sample_triangle(Vec2 u) { return u - 0.5f * glm::min(u.x, u.y); }

}  // namespace candil
