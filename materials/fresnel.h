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

/// Unpolarised reflectance of a metal (Fresnel's equations for a complex index; Born and Wolf, "Principles of Optics",
/// section 14.2). `cosine` in (0, 1]; the index on the other side divided by the one on this side is eta - i k, both at
/// least 0.
inline float fresnel_conductor(float cosine, float eta, float k) {
  const float cos2 = sqr(cosine), sin2 = 1 - cos2;
  // The refracted ray's complex (index times cosine) is a - i b; a^2 - b^2 = difference, a^2 + b^2 = sum.
  const float difference = sqr(eta) - sqr(k) - sin2;
  const float product = eta * k;
  const float sum = glm::sqrt(sqr(difference) + 4 * sqr(product));
  // Of the two ways to write a^2, the one that does not subtract equal numbers.
  const float a2 = difference > 0 ? 0.5f * (sum + difference) : 2 * sqr(product) / glm::max(sum - difference, 1e-20f);
  const float a = glm::sqrt(a2);
  const float perpendicular = (sum + cos2 - 2 * a * cosine) / (sum + cos2 + 2 * a * cosine);
  const float divisor = sum * cos2 + sqr(sin2) + 2 * a * cosine * sin2;
  if (!(divisor > 0)) return perpendicular;  // eta = k = 0 at normal incidence, where both are the same
  const float parallel = perpendicular * (sum * cos2 + sqr(sin2) - 2 * a * cosine * sin2) / divisor;
  return 0.5f * (perpendicular + parallel);
}

inline Vec3 fresnel_conductor(float cosine, Vec3 eta, Vec3 k) {
  return {fresnel_conductor(cosine, eta.x, k.x), fresnel_conductor(cosine, eta.y, k.y),
          fresnel_conductor(cosine, eta.z, k.z)};
}

/// Mean of it over the cosine-weighted hemisphere, to 1e-4.
Vec3 fresnel_conductor_average(Vec3 eta, Vec3 k);

/// Reflectance at normal incidence. An index of 0 stands for an infinite one (KHR_materials_ior): 1.
inline float reflectance_of_ior(float ior) { return ior == 0 ? 1.0f : sqr((ior - 1) / (ior + 1)); }

/// A relative index of refraction this close to 1 hides the roughness of an interface: it reflects less than 2.5e-7,
/// and facets do not bend light visibly.
inline bool is_index_matched(float relative_ior) { return glm::abs(relative_ior - 1) < 1e-3f; }

/// Direction refracted at a facet `h`; `w` and `h` unit, dot(w, h) > 0. Not to be called under total internal
/// reflection.
inline Vec3 refract(Vec3 w, Vec3 h, float eta) {
  const float cosine = glm::dot(w, h);
  const float cos_transmitted = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(eta));
  return -w / eta + (cosine / eta - cos_transmitted) * h;
}

}  // namespace candil
