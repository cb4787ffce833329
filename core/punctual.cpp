#include "core/punctual.h"

#include <cmath>

#include "core/color.h"

namespace candil {
namespace {

float spot_attenuation(const PunctualLight& light, Vec3 wi) {
  const float cos_outer = std::cos(light.outer_cone), cos_inner = std::cos(light.inner_cone);
  const float scale = 1 / glm::max(0.001f, cos_inner - cos_outer);
  return sqr(glm::clamp((-glm::dot(light.direction, wi) - cos_outer) * scale, 0.0f, 1.0f));
}

float range_attenuation(float distance, float range) {
  if (!(range < infinity)) return 1;
  return glm::clamp(1 - sqr(sqr(distance / range)), 0.0f, 1.0f);
}

}  // namespace

Vec3 punctual_irradiance(const PunctualLight& light, Vec3 wi, float distance) {
  float factor = range_attenuation(distance, light.range) / sqr(distance);
  if (light.kind == PunctualKind::spot) factor *= spot_attenuation(light, wi);
  return factor * light.intensity;
}

std::optional<LightSample> sample_punctual(const PunctualLight& light, const SurfacePoint& from) {
  LightSample sample;
  sample.is_delta = true;
  sample.pdf = 1;
  float distance = infinity;
  if (light.kind == PunctualKind::directional) {
    sample.wi = -light.direction;
    sample.radiance = light.intensity;
  } else {
    const Vec3 towards = light.position - from.position;
    distance = glm::length(towards);
    if (!(distance > 0)) return std::nullopt;
    sample.wi = towards / distance;
    sample.radiance = punctual_irradiance(light, sample.wi, distance);
  }
  if (is_black(sample.radiance)) return std::nullopt;
  sample.shadow_ray = {offset_origin(from, sample.wi), sample.wi, distance};
  return sample;
}

float punctual_power(const PunctualLight& light, float scene_radius) {
  const float intensity = luminance(light.intensity);
  switch (light.kind) {
    case PunctualKind::point:
      return 4 * pi * intensity;
    case PunctualKind::spot:
      return 2 * pi * (1 - std::cos(0.5f * (light.inner_cone + light.outer_cone))) * intensity;
    case PunctualKind::directional:
      return pi * sqr(scene_radius) * intensity;
  }
  return 0;
}

}  // namespace candil
