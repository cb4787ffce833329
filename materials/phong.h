/// Phong's model made energy-conserving (Lafortune and Willems 1994, "Using the Modified Phong Reflectance Model for
/// Physically Based Rendering"): f = kd / pi + ks (n + 2) / (2 pi) max(0, cos a)^n, where a is the angle between wi and
/// the mirror direction of wo. It is the same with wo and wi exchanged.
///
/// The factor (n + 2) / (2 pi) makes the specular albedo ks at normal incidence; it falls towards grazing angles, where
/// part of the lobe is below the surface, and where the cosine of the lighting narrows the rest. Hence the albedo never
/// exceeds kd + ks, and kd + ks <= 1 conserves energy. An infinite exponent stands for an ideal mirror of reflectance
/// ks at every angle: alone it is a perfect specular, with kd plastic. (The limit of growing exponents is darker: ks
/// times the cosine of incidence.) Local frame: z is the shading normal, wo.z > 0.
#pragma once

#include <optional>

#include "materials/bsdf_sample.h"
#include "materials/shadow_terminator.h"

namespace candil {

struct PhongParameters {
  Vec3 diffuse{0.0f};         ///< kd.
  Vec3 specular{0.0f};        ///< ks, not black.
  float exponent = infinity;  ///< n, at least 0; infinite: a mirror.
};

class PhongLobes {
 public:
  explicit PhongLobes(const PhongParameters& parameters);

  BsdfEval eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const;
  /// Lobes are chosen with probabilities in proportion to max(kd) and max(ks), the specular one sampled by cos^n.
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u_direction, const ShadowTerminator& terminator) const;
  bool is_purely_delta() const { return is_delta() && is_black(diffuse_); }
  Vec3 albedo() const { return diffuse_ + specular_; }
  /// max(kd) + max(ks), which may exceed 1 where their colours differ.
  float survival_probability() const { return survival_probability_; }

 private:
  bool is_delta() const { return exponent_ == infinity; }

  Vec3 diffuse_, specular_;
  float exponent_;
  float survival_probability_, specular_probability_;
};

}  // namespace candil
