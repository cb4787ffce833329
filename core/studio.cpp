#include "core/studio.h"

#include <array>
#include <cmath>

namespace candil {
namespace {

/// A soft box: a rectangle at unit distance with rounded, fading edges.
struct SoftBox {
  float azimuth, elevation;       // degrees; azimuth 0 is +Z, positive towards +X
  float half_width, half_height;  // tangents of the half angles
  float radiance;
};

constexpr std::array<SoftBox, 4> soft_boxes = {{
    {-30, 42, 0.55f, 0.45f, 3.6f},  // key: above left of the automatic camera
    {95, 18, 0.40f, 0.80f, 1.4f},   // fill: tall, to the right
    {200, 35, 0.90f, 0.25f, 3.0f},  // rim: a wide strip behind
    {0, 90, 0.60f, 0.60f, 1.2f},    // ceiling
}};

float smooth_edge(float distance, float half_extent, float softness) {
  return 1 - glm::smoothstep(half_extent - softness, half_extent + softness, std::abs(distance));
}

float box_radiance(const SoftBox& box, Vec3 direction) {
  const float azimuth = glm::radians(box.azimuth), elevation = glm::radians(box.elevation);
  const Vec3 axis(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  std::cos(elevation) * std::cos(azimuth));
  const float depth = glm::dot(direction, axis);
  if (depth <= 0) return 0;
  const Vec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
  const Vec3 up = glm::cross(axis, right);
  const float x = glm::dot(direction, right) / depth, y = glm::dot(direction, up) / depth;
  return box.radiance * smooth_edge(x, box.half_width, 0.06f) * smooth_edge(y, box.half_height, 0.06f);
}

}  // namespace

Environment make_studio_environment() {
  constexpr int width = 512, height = 256;
  Environment environment;
  environment.tint = Vec3(1);
  environment.backdrop = Vec3(0.50f, 0.51f, 0.53f);
  environment.image = Image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    const float theta = pi * (static_cast<float>(y) + 0.5f) / height;
    for (int x = 0; x < width; ++x) {
      const float phi = 2 * pi * ((static_cast<float>(x) + 0.5f) / width - 0.5f);
      const Vec3 direction(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
      // The room: a grey floor that brightens towards the ceiling.
      float radiance = 0.20f + 0.20f * glm::smoothstep(-0.3f, 0.9f, direction.y);
      for (const SoftBox& box : soft_boxes) radiance += box_radiance(box, direction);
      float* pixel = environment.image.pixel(x, y);
      pixel[0] = pixel[1] = pixel[2] = radiance;
    }
  }
  return environment;
}

}  // namespace candil
