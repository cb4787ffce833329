/// The normals that closures are built around: of the surface, bent by a normal map, and made to suit the viewer.
#pragma once

#include "core/surface.h"
#include "core/texture.h"

namespace candil {

/// Front-side shading normal with a normal map applied, x and y of it scaled (glTF 2.0, section 3.9.3).
inline Vec3 mapped_normal(const Scene& scene, const TextureSlot& map, float scale, const SurfacePoint& point) {
  if (!map.is_used() || point.tangent.w == 0) return point.normal;
  const Vec3 t = 2.0f * Vec3(sample_texture(scene, map, point.uv, ColorSpace::linear)) - 1.0f;
  const Vec3 tangent(point.tangent);
  const Vec3 bitangent = (point.tangent.w < 0 ? -1.0f : 1.0f) * glm::cross(point.normal, tangent);
  const Vec3 n = scale * (t.x * tangent + t.y * bitangent) + t.z * point.normal;
  const float squared = length_squared(n);
  return squared > 0 ? n / glm::sqrt(squared) : point.normal;
}

/// A shading normal that suits `wo` and the surface, both on the same side of it: wo is above the normal, and so is the
/// mirror direction above the surface. Where interpolation or a normal map went too far, the mirror direction is lifted
/// to the horizon and the normal is put half-way between it and wo, so that specular light is bent rather than lost.
inline Vec3 valid_normal(Vec3 normal, Vec3 normal_of_sides, Vec3 wo, bool has_specular) {
  constexpr float least_cosine = 1e-3f;
  const float cosine = glm::dot(normal, wo);
  if (cosine < least_cosine) normal = glm::normalize(normal + (least_cosine - cosine) * wo);
  if (!has_specular) return normal;
  const Vec3 mirrored = 2 * glm::dot(normal, wo) * normal - wo;
  const float height = glm::dot(mirrored, normal_of_sides);
  const float least_height = glm::min(least_cosine, 0.5f * glm::dot(wo, normal_of_sides));
  if (height >= least_height) return normal;
  const Vec3 half = wo + glm::normalize(mirrored + (least_height - height) * normal_of_sides);
  const float squared = length_squared(half);
  return squared > 0 ? half / glm::sqrt(squared) : normal_of_sides;
}

}  // namespace candil
