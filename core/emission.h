/// What a surface emits and how much of it is there: the part of a material that lights and shadow rays need.
#pragma once

#include "core/scene.h"
#include "core/surface.h"

namespace candil {

/// Radiance, W/(sr m2), that leaves the point on its front (or back) side; a single-sided material emits from
/// its front only. An unlit material emits its base colour.
Vec3 emitted_radiance(const Scene& scene, const SurfacePoint& point, bool is_front);

/// Linear RGBA base colour: factor times texture times vertex colour.
Vec4 base_color(const Scene& scene, const Material& material, const Vec2 (&uv)[2], Vec4 vertex_color);

/// Fraction of the surface that is there, 0 to 1 (glTF 2.0, section 3.9.4): 1 for OPAQUE, 0 or 1 for MASK, the base
/// colour's alpha for BLEND.
float alpha_coverage(const Scene& scene, const Material& material, const Vec2 (&uv)[2], Vec4 vertex_color);

}  // namespace candil
