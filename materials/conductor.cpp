#include "materials/conductor.h"

#include "core/color.h"
#include "core/warp.h"
#include "materials/fresnel.h"
#include "materials/ggx.h"

namespace candil {

ConductorLobes::ConductorLobes(const ConductorParameters& p, const GgxAlbedo& table, Vec3 wo)
    : table_(&table),
      roughness_(p.roughness),
      alpha_(sqr(p.roughness)),
      is_delta_(alpha_ < ggx_min_alpha),
      tint_(p.tint),
      eta_(p.eta),
      k_(p.k) {
  if (is_delta_) {
    albedo_ = tint_ * fresnel_conductor(wo.z, eta_, k_);
    return;
  }
  const float single = table.directional(roughness_, wo.z).total(), mean = table.average(roughness_).total();
  const float lost = glm::max(0.0f, 1 - single);
  const Vec3 color = tint_ * multiple_scattering_color(p.mean_fresnel, mean);
  multiple_ = color * (lost / glm::max(1e-6f, 1 - mean));
  const Vec3 specular = tint_ * p.mean_fresnel * single, broad = color * lost;
  albedo_ = specular + broad;
  // Choose lobes by the energy that each returns towards wo.
  const float energy = luminance(albedo_);
  if (energy > 0) specular_probability_ = luminance(specular) / energy;
}

BsdfEval ConductorLobes::eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const {
  if (is_delta_ || wi.z <= 0 || wo.z <= 0) return {};
  const float lost = glm::max(0.0f, 1 - table_->directional(roughness_, wi.z).total());
  const float cosine_pdf = pdf_cosine_hemisphere(wi.z);
  const GgxReflection facets = ggx_reflection(wo, wi, alpha_);
  return {multiple_ * (lost * cosine_pdf * terminator.factor(wi)) +
              tint_ * fresnel_conductor(facets.cosine, eta_, k_) * facets.value,
          (1 - specular_probability_) * cosine_pdf + specular_probability_ * facets.pdf};
}

std::optional<BsdfSample> ConductorLobes::sample(Vec3 wo, float u_lobe, Vec2 u_direction,
                                                 const ShadowTerminator& terminator) const {
  if (wo.z <= 0) return std::nullopt;
  if (is_delta_) return mirror_sample(wo, albedo_, 1);
  Vec3 wi;
  if (u_lobe < specular_probability_) {
    wi = sample_ggx_reflection(wo, alpha_, u_direction);
  } else {
    wi = sample_cosine_hemisphere(u_direction);
  }
  return sample_of(wi, eval(wo, wi, terminator));
}

}  // namespace candil
