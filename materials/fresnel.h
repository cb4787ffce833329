/// Reflectance of a smooth interface.
#pragma once

#include "core/math.h"

namespace candil {

/// Schlick's approximation between the reflectance at normal and at grazing incidence (glTF 2.0, appendix B.3.4).
inline Vec3 fresnel_schlick(Vec3 f0, Vec3 f90, float cosine) {
  const float m = glm::clamp(1 - cosine, 0.0f, 1.0f);
  return f0 + (f90 - f0) * (sqr(sqr(m)) * m);
}

/// Mean of Schlick's approximation over the cosine-weighted hemisphere: 2 * integral of mu (1 - mu)^5 is 1/21.
inline Vec3 fresnel_schlick_average(Vec3 f0, Vec3 f90) { return f0 + (f90 - f0) / 21.0f; }

/// Unpolarised reflectance of a dielectric (Fresnel's equations). `cosine` in [0, 1] is taken on the incident side,
/// `eta` is the index on the other side divided by the one on this side. 1 under total internal reflection.
inline float fresnel_dielectric(float cosine, float eta) {
  const float sin2_transmitted = (1 - sqr(cosine)) / sqr(eta);
  if (sin2_transmitted >= 1) return 1;
  const float cos_transmitted = glm::sqrt(1 - sin2_transmitted);
  const float parallel = (eta * cosine - cos_transmitted) / (eta * cosine + cos_transmitted);
  const float perpendicular = (cosine - eta * cos_transmitted) / (cosine + eta * cos_transmitted);
  return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

/// Reflectance at normal incidence. An index of 0 stands for an infinite one (KHR_materials_ior): 1.
inline float reflectance_of_ior(float ior) { return ior == 0 ? 1.0f : sqr((ior - 1) / (ior + 1)); }

/// Direction refracted at a facet `h`; `w` and `h` unit, dot(w, h) > 0. Not to be called under total internal
/// reflection.
inline Vec3 refract(Vec3 w, Vec3 h, float eta) {
  const float cosine = glm::dot(w, h);
  const float cos_transmitted = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(eta));
  return -w / eta + (cosine / eta - cos_transmitted) * h;
}

}  // namespace candil
