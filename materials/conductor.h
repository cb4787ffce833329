/// Metals by their complex index of refraction: one GGX lobe with Fresnel's exact equations at its facets.
///
/// Energy lost between facets comes back as a diffuse-like lobe, coloured by repeated reflection (Kulla and Conty 2017,
/// as in opaque.h). Smooth ones are mirrors. Everything is multiplied by a tint.
/// Local frame: z is the shading normal, wo.z > 0.
#pragma once

#include <optional>

#include "materials/bsdf_sample.h"
#include "materials/ggx_albedo.h"
#include "materials/shadow_terminator.h"

namespace candil {

struct ConductorParameters {
  float roughness = 0;      ///< Perceptual.
  Vec3 tint{1.0f};          ///< Factor of all that is reflected.
  Vec3 eta{0.2f}, k{3.0f};  ///< Index eta - i k.
  Vec3 mean_fresnel{1.0f};  ///< fresnel_conductor_average() of that index.
};

class ConductorLobes {
 public:
  ConductorLobes(const ConductorParameters& parameters, const GgxAlbedo& table, Vec3 wo);

  BsdfEval eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const;
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u_direction, const ShadowTerminator& terminator) const;
  bool is_purely_delta() const { return is_delta_; }
  Vec3 albedo() const { return albedo_; }
  float survival_probability() const { return max_component(albedo_); }

 private:
  const GgxAlbedo* table_;
  float roughness_, alpha_;
  bool is_delta_;
  float specular_probability_ = 1;
  Vec3 tint_, eta_, k_;
  Vec3 multiple_{0.0f};  // colour x (1 - E(wo)) / (1 - mean E)
  Vec3 albedo_;
};

}  // namespace candil
