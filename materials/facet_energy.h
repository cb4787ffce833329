/// Energy that one visible facet of a GGX interface sends on, in directions that are not shadowed: what the tables of
/// albedos average.
#pragma once

#include "materials/fresnel.h"
#include "materials/ggx.h"

namespace candil {

/// Share of what the facet h reflects towards wo that is not shadowed, as if it reflected everything.
template <typename Alpha>
float reflected_share(Vec3 wo, Vec3 h, Alpha alpha) {
  const Vec3 wi = 2 * glm::dot(wo, h) * h - wo;
  return wi.z > 0 ? ggx_masking_shadowing(wo, wi, alpha) / ggx_masking(wo, alpha) : 0.0f;
}

/// The same of what it refracts, as if it let everything through; not under total internal reflection. `eta`: index
/// beyond it over the one before it.
template <typename Alpha>
float refracted_share(Vec3 wo, Vec3 h, Alpha alpha, float eta) {
  const Vec3 wi = refract(wo, h, eta);
  return wi.z < 0 ? ggx_masking_shadowing(wo, wi, alpha) / ggx_masking(wo, alpha) : 0.0f;
}

/// How much less energy comes of what the facet reflects instead of refracting it; 0 where all is reflected anyway.
template <typename Alpha>
float less_kept_by_reflecting(Vec3 wo, Vec3 h, Alpha alpha, float eta) {
  const float cosine = glm::dot(wo, h);
  if (!(cosine > 0 && 1 - (1 - sqr(cosine)) / sqr(eta) > 0)) return 0;
  return refracted_share(wo, h, alpha, eta) - reflected_share(wo, h, alpha);
}

/// A smooth dielectric facet; eta is the index beyond it over the one before it. Reflectance may follow from another.
template <typename Alpha>
float dielectric_energy(Vec3 wo, Vec3 h, Alpha alpha, float eta, float reflecting_eta) {
  const float cosine = glm::dot(wo, h);
  if (cosine <= 0) return 0;
  const float reflectance = fresnel_dielectric(cosine, reflecting_eta);
  const float masking = ggx_masking(wo, alpha);
  float energy = 0;
  const Vec3 reflected = 2 * cosine * h - wo;
  if (reflected.z > 0) energy += reflectance * ggx_masking_shadowing(wo, reflected, alpha) / masking;
  if (reflectance < 1) {
    const Vec3 refracted = refract(wo, h, eta);
    if (refracted.z < 0) energy += (1 - reflectance) * ggx_masking_shadowing(wo, refracted, alpha) / masking;
  }
  return energy;
}
template <typename Alpha>
float dielectric_energy(Vec3 wo, Vec3 h, Alpha alpha, float eta) {
  return dielectric_energy(wo, h, alpha, eta, eta);
}

}  // namespace candil
