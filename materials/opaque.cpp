#include "materials/opaque.h"

#include "core/color.h"
#include "core/warp.h"
#include "materials/fresnel.h"
#include "materials/ggx.h"

namespace candil {

OpaqueLobes::OpaqueLobes(const OpaqueParameters& p, const GgxAlbedo& table, Vec3 wo)
    : table_(&table),
      roughness_(p.roughness),
      alpha_(sqr(p.roughness)),
      f0_(glm::mix(p.coat_f0, p.base, p.metallic)),
      f90_(glm::mix(p.coat_f90, Vec3(1), p.metallic)),
      diffuse_((1 - p.metallic) * p.base),
      coat_f0_(max_component(p.coat_f0)),
      coat_f90_(max_component(p.coat_f90)),
      albedo_(diffuse_) {
  has_specular_ = max_component(glm::max(f0_, f90_)) > 0;
  if (!has_specular_) return;
  is_delta_ = alpha_ < ggx_min_alpha;
  if (is_delta_) roughness_ = 0;
  const GgxAlbedo::Split single = is_delta_ ? GgxAlbedo::Split{1 - fresnel_schlick(Vec3(0), Vec3(1), wo.z).x,
                                                               fresnel_schlick(Vec3(0), Vec3(1), wo.z).x}
                                            : table.directional(roughness_, wo.z);
  const GgxAlbedo::Split mean = table.average(roughness_);
  const Vec3 specular = f0_ * single.scale + f90_ * single.bias;
  if (!is_delta_) {
    const auto multiple_color = [&](Vec3 f0, Vec3 f90) {
      return multiple_scattering_color(fresnel_schlick_average(f0, f90), mean.total());
    };
    const float lost = glm::max(0.0f, 1 - single.total()), mean_lost = glm::max(1e-6f, 1 - mean.total());
    // Unlike the single-scattering lobe, this one is not linear in f0: metal and coat each have their own colour.
    const Vec3 coat_color = multiple_color(p.coat_f0, p.coat_f90);
    const Vec3 metal_color = multiple_color(p.base, Vec3(1));
    multiple_ = glm::mix(coat_color, metal_color, p.metallic) * (lost / mean_lost);
    coat_multiple_ = multiple_color(Vec3(coat_f0_), Vec3(coat_f90_)).x;
  }
  if (!is_black(diffuse_)) {
    const auto coat = [&](const GgxAlbedo::Split& s) {
      return coat_f0_ * s.scale + coat_f90_ * s.bias + coat_multiple_ * (1 - s.total());
    };
    diffuse_ *= glm::max(0.0f, 1 - coat(single)) / glm::max(1e-6f, 1 - coat(mean));
  }
  // Choose lobes by the energy that each returns towards wo.
  const Vec3 broad =
      multiple_ * (1 - mean.total()) + diffuse_ * glm::max(0.0f, 1 - (coat_f0_ * mean.scale + coat_f90_ * mean.bias));
  const float specular_energy = luminance(specular), broad_energy = luminance(broad);
  specular_probability_ = broad_energy > 0 ? specular_energy / (specular_energy + broad_energy) : 1.0f;
  albedo_ = glm::min(specular + broad, Vec3(1));
}

/// Base and multiple scattering: everything that is sampled by the cosine. Without the factor cos / pi.
Vec3 OpaqueLobes::diffuse_like(float cosine_i) const {
  if (!has_specular_) return diffuse_;
  if (is_delta_) {
    const float schlick = fresnel_schlick(Vec3(0), Vec3(1), cosine_i).x;
    return diffuse_ * (1 - (coat_f0_ * (1 - schlick) + coat_f90_ * schlick));
  }
  const GgxAlbedo::Split single = table_->directional(roughness_, cosine_i);
  const float lost = glm::max(0.0f, 1 - single.total());
  const float coat = coat_f0_ * single.scale + coat_f90_ * single.bias + coat_multiple_ * lost;
  return diffuse_ * glm::max(0.0f, 1 - coat) + multiple_ * lost;
}

BsdfEval OpaqueLobes::eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const {
  if (wi.z <= 0 || wo.z <= 0) return {};
  const float cosine_pdf = pdf_cosine_hemisphere(wi.z);
  BsdfEval result{diffuse_like(wi.z) * (cosine_pdf * terminator.factor(wi)), (1 - specular_probability_) * cosine_pdf};
  if (has_specular_ && !is_delta_) {
    const GgxReflection facets = ggx_reflection(wo, wi, alpha_);
    result.f_cos += fresnel_schlick(f0_, f90_, facets.cosine) * facets.value;
    result.pdf += specular_probability_ * facets.pdf;
  }
  return result;
}

std::optional<BsdfSample> OpaqueLobes::sample(Vec3 wo, float u_lobe, Vec2 u_direction,
                                              const ShadowTerminator& terminator) const {
  if (wo.z <= 0) return std::nullopt;
  Vec3 wi;
  if (u_lobe < specular_probability_) {
    if (is_delta_) return mirror_sample(wo, fresnel_schlick(f0_, f90_, wo.z), specular_probability_);
    wi = sample_ggx_reflection(wo, alpha_, u_direction);
  } else {
    wi = sample_cosine_hemisphere(u_direction);
  }
  return sample_of(wi, eval(wo, wi, terminator));
}

}  // namespace candil
