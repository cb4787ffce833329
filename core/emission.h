/// What a surface emits and how much of it is there: the part of a material that lights and shadow rays need.
#pragma once

#include "core/scene.h"
#include "core/surface.h"

namespace candil {

/// Radiance, W/(sr m2), that leaves the point on its front (or back) side; a single-sided material emits from
/// its front only. An unlit material emits its base colour.
inline Vec3 emitted_radiance(const Scene& scene, const SurfacePoint& point, bool is_front);
/// The same for a material that is_emissive(), the point's own.
Vec3 emitted_radiance(const Scene& scene, const Material& material, const SurfacePoint& point, bool is_front);

inline Vec3 emitted_radiance(const Scene& scene, const SurfacePoint& point, bool is_front) {
  const Material& material = scene.materials[point.material];
  return material.is_emissive() ? emitted_radiance(scene, material, point, is_front) : Vec3(0);
}

/// The base colour's texture; only for a material that has one.
Vec4 base_color_texel(const Scene& scene, const Material& material, const Vec2 (&uv)[2]);
/// Linear RGBA base colour: factor times texture times vertex colour.
inline Vec4 base_color(const Scene& scene, const Material& material, const Vec2 (&uv)[2], const Vec4& vertex_color) {
  const Vec4 color = material.base_color * vertex_color;
  return material.base_color_texture.is_used() ? color * base_color_texel(scene, material, uv) : color;
}

/// Fraction of the surface that is there, 0 to 1 (glTF 2.0, section 3.9.4): 1 for OPAQUE, 0 or 1 for MASK, the base
/// colour's alpha for BLEND.
float alpha_coverage(const Scene& scene, const Material& material, const Vec2 (&uv)[2], Vec4 vertex_color);

}  // namespace candil
