#include "core/emission.h"

#include "core/texture.h"

namespace candil {

Vec3 emitted_radiance(const Scene& scene, const Material& material, const SurfacePoint& point, bool is_front) {
  if (!is_front && !material.is_double_sided) return Vec3(0);
  if (material.is_unlit) return Vec3(base_color(scene, material, point.uv, point.color));
  if (!material.emission_texture.is_used()) return material.emission;
  return material.emission * Vec3(sample_texture(scene, material.emission_texture, point.uv, ColorSpace::srgb));
}

Vec4 base_color_texel(const Scene& scene, const Material& material, const Vec2 (&uv)[2]) {
  return sample_texture(scene, material.base_color_texture, uv, ColorSpace::srgb);
}

float alpha_coverage(const Scene& scene, const Material& material, const Vec2 (&uv)[2], Vec4 vertex_color) {
  if (material.alpha_mode == AlphaMode::opaque) return 1;
  const float alpha = base_color(scene, material, uv, vertex_color).w;
  if (material.alpha_mode == AlphaMode::mask) return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
  return glm::clamp(alpha, 0.0f, 1.0f);
}

}  // namespace candil
