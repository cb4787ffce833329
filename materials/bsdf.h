/// The closure of one hit: how light scatters there. A value on the stack, made once per hit by make_bsdf(), with every
/// texture already read.
///
/// Directions: `wo` points to the previous vertex (towards the camera), `wi` to the next one (towards the light); both
/// are unit vectors in world space and point away from the surface. Radiance flows from wi to wo: for transmission into
/// a medium of relative index eta the values contain the factor 1/eta^2 of radiance (Veach 1997, section 5.2).
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/surface.h"
#include "core/warp.h"
#include "core/wavelength.h"
#include "materials/bsdf_tables.h"
#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/layers.h"
#include "materials/opaque.h"
#include "materials/phong.h"

namespace candil {

class Bsdf {
 public:
  /// f |cos| and the density of sample(), 1/sr, over all lobes; delta lobes add nothing to either.
  BsdfEval eval(Vec3 wo, Vec3 wi) const {
    return kind_ == Kind::lambertian ? eval_lambertian(wi) : eval_layered(wo, wi);
  }
  /// A direction; nothing when the path ends here (absorbed, or below the surface). u in [0, 1).
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u_direction) const {
    return kind_ == Kind::lambertian ? sample_lambertian(u_direction) : sample_layered(wo, u_lobe, u_direction);
  }
  /// Only delta lobes: light sampling cannot contribute.
  bool is_purely_delta() const { return kind_ == Kind::lambertian ? is_black(diffuse_) : has_only_delta_lobes(); }
  /// Reflectance and transmittance together, roughly, for feature images; in [0, 1].
  Vec3 albedo() const;
  /// Largest component of what is scattered, roughly, for a roulette that absorbs paths: Phong's max(kd) + max(ks), 1
  /// for a dielectric; positive unless nothing is scattered at all. May exceed 1.
  float survival_probability() const;
  /// Unit, on the side of wo, after normal mapping.
  Vec3 shading_normal() const { return frame_.normal; }

 private:
  friend Bsdf make_bsdf(const Scene&, const BsdfTables&, const SurfacePoint&, Vec3 wo, const Wavelength&);
  Bsdf(Vec3 shading_normal, Vec3 normal_of_sides)
      : frame_(shading_normal), normal_of_sides_(normal_of_sides), is_flat_(shading_normal == normal_of_sides) {}
  /// Whether wi leaves on the side that the local frame and the surface agree on.
  bool sides_agree(Vec3 wi, float local_z) const { return glm::dot(wi, normal_of_sides_) * local_z > 0; }

  bool has_only_delta_lobes() const;
  // Most vertices of most scenes: in the header, for the loops of integrators.
  BsdfEval eval_lambertian(Vec3 wi) const;
  std::optional<BsdfSample> sample_lambertian(Vec2 u) const;
  /// Of a smooth surface, both cosines positive.
  float lambertian_terminator(float cosine, float cosine_surface) const {
    return ShadowTerminator::factor(cosine, cosine_surface, glm::dot(frame_.normal, normal_of_sides_));
  }
  /// All kinds but the Lambertian, with layers on them if there are any.
  BsdfEval eval_layered(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample_layered(Vec3 wo, float u_lobe, Vec2 u_direction) const;
  /// Below the layers.
  BsdfEval eval_base(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample_base(Vec3 wo, float u_lobe, Vec2 u_direction) const;
  Vec3 base_albedo() const;
  float base_survival_probability() const;
  ShadowTerminator shadow_terminator() const;
  /// Calls `function` with the lobes that reflect; to be asked only if there are any.
  template <typename Function>
  auto with_reflecting(const Function& function) const;
  /// The same with those that transmit.
  template <typename Function>
  auto with_transmitting(const Function& function) const {
    return dielectric_ ? function(*dielectric_) : function(*extended_dielectric_);
  }

  Frame frame_;           // z: shading normal, on the side of wo
  Vec3 normal_of_sides_;  // on the side of wo
  /// Which lobes there are, besides dielectric_.
  enum class Kind : std::uint8_t {
    lambertian,  // none: diffuse_ alone
    opaque,
    phong,
    conductor,
    extended_opaque,
  };
  Kind kind_ = Kind::opaque;
  bool is_flat_;                 // the shading normal is the surface's own
  Vec3 diffuse_;                 // albedo; has a value if lambertian
  float dielectric_weight_ = 0;  // 0: reflecting lobes only; 1: dielectric lobes only
  // Each is there when the kind and the weight give it a share; most surfaces never pay for the others.
  std::optional<OpaqueLobes> opaque_;
  std::optional<PhongLobes> phong_;
  std::optional<ConductorLobes> conductor_;
  std::optional<DielectricLobes> dielectric_;
  std::optional<Layers> layers_;  // on all of them; never on a Lambertian kind
  std::optional<ExtendedOpaqueLobes> extended_opaque_;
  std::optional<ExtendedDielectricLobes> extended_dielectric_;
};

inline BsdfEval Bsdf::eval_lambertian(Vec3 wi) const {
  const float cosine = glm::dot(wi, frame_.normal), cosine_surface = glm::dot(wi, normal_of_sides_);
  if (!(cosine > 0 && cosine_surface > 0)) return {};
  const float pdf = pdf_cosine_hemisphere(cosine);
  if (is_flat_) return {diffuse_ * pdf, pdf};
  return {diffuse_ * (pdf * lambertian_terminator(cosine, cosine_surface)), pdf};
}

inline std::optional<BsdfSample> Bsdf::sample_lambertian(Vec2 u) const {
  std::optional<BsdfSample> result;
  const Vec3 local = sample_cosine_hemisphere(u);
  const Vec3 wi = frame_.to_world(local);
  const float cosine_surface = glm::dot(wi, normal_of_sides_);
  if (!(local.z > 0 && cosine_surface > 0)) return result;
  BsdfSample& sample = result.emplace();
  sample.wi = wi;
  sample.weight = diffuse_;
  if (!is_flat_) sample.weight *= lambertian_terminator(local.z, cosine_surface);
  sample.pdf = pdf_cosine_hemisphere(local.z);
  return result;
}

/// The closure of the material at a point, seen from `wo`. The wavelength is for materials that disperse light: what is
/// transmitted takes its response; without one they have their mean index.
Bsdf make_bsdf(const Scene& scene, const BsdfTables& tables, const SurfacePoint& point, Vec3 wo,
               const Wavelength& wavelength = {});

}  // namespace candil
