/// Softens the edge between light and shadow where a normal map, or normals far off their triangle, lie about the
/// surface (Chiang, Li and Burley 2019, "Taming the Shadow Terminator"). Interpolated normals of smooth meshes need it
/// no more: face_viewer() has moved the point to the surface that they stand for.
///
/// Light from behind the surface never reaches it, although the bent normal may still face the light: diffuse shading
/// then ends in a hard edge. Broad lobes fade out towards that horizon instead. The factor never exceeds 1, so no
/// energy is made; it is exactly 1 where both normals are the same. Narrow lobes do not need it: make_bsdf() bends the
/// normal until their mirror direction is above the surface, and darkening them there would draw black edges.
#pragma once

#include "core/math.h"

namespace candil {

class ShadowTerminator {
 public:
  /// Off: the shading normal is that of the surface.
  ShadowTerminator() = default;
  /// Normal of the surface in the local frame of the closure, unit; z is the shading normal.
  explicit ShadowTerminator(Vec3 surface_normal) : surface_normal_(surface_normal), is_on_(true) {}

  /// Factor of light from wi, local, in [0, 1].
  float factor(Vec3 wi) const {
    if (!is_on_) return 1;
    return factor(wi.z, glm::dot(wi, surface_normal_), surface_normal_.z);
  }

  /// The same from the cosines of wi with both normals, the first of them positive, and of the normals with each other.
  static float factor(float cosine_shading, float cosine_surface, float cosine_of_normals) {
    const float expected = cosine_shading * cosine_of_normals;
    if (cosine_surface >= expected) return 1;
    if (cosine_surface <= 0) return 0;
    const float g = cosine_surface / expected;
    return g * (1 + g * (1 - g));
  }

 private:
  Vec3 surface_normal_{0, 0, 1};
  bool is_on_ = false;
};

}  // namespace candil
