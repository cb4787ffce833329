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
      diffuse_((1 - p.metallic) * (1 - p.diffuse_transmission) * p.base),
      transmitted_((1 - p.metallic) * p.diffuse_transmission * p.transmission_color),
      coat_f0_(max_component(p.coat_f0)),
      coat_f90_(max_component(p.coat_f90)),
      albedo_(diffuse_ + transmitted_) {
  const float energy_through = luminance(transmitted_);
  if (energy_through > 0) transmission_probability_ = energy_through / (energy_through + luminance(diffuse_));
  has_specular_ = max_component(glm::max(f0_, f90_)) > 0;
  if (!has_specular_) return;
  is_delta_ = alpha_ < ggx_min_alpha;
  if (is_delta_) roughness_ = 0;
  const GgxAlbedo::Split single = single_scattering(wo.z);
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
  if (!is_black(diffuse_) || !is_black(transmitted_)) {
    const auto coat = [&](const GgxAlbedo::Split& s) {
      return coat_f0_ * s.scale + coat_f90_ * s.bias + coat_multiple_ * (1 - s.total());
    };
    const float left_over = glm::max(0.0f, 1 - coat(single)) / glm::max(1e-6f, 1 - coat(mean));
    diffuse_ *= left_over;
    transmitted_ *= left_over;
  }
  // Choose lobes by the energy that each returns towards wo.
  const float to_base = glm::max(0.0f, 1 - (coat_f0_ * mean.scale + coat_f90_ * mean.bias));
  const Vec3 broad = multiple_ * (1 - mean.total()) + diffuse_ * to_base, through = transmitted_ * to_base;
  const float specular_energy = luminance(specular), through_energy = luminance(through);
  const float other_energy = luminance(broad) + through_energy;
  specular_probability_ = other_energy > 0 ? specular_energy / (specular_energy + other_energy) : 1.0f;
  transmission_probability_ = through_energy > 0 ? through_energy / (specular_energy + other_energy) : 0.0f;
  albedo_ = glm::min(specular + broad + through, Vec3(1));
}

GgxAlbedo::Split OpaqueLobes::single_scattering(float cosine) const {
  if (!is_delta_) return table_->directional(roughness_, cosine);
  const float schlick = fresnel_schlick(Vec3(0), Vec3(1), cosine).x;
  return {1 - schlick, schlick};
}

float OpaqueLobes::left_by_coat(const GgxAlbedo::Split& single) const {
  const float lost = is_delta_ ? 0.0f : glm::max(0.0f, 1 - single.total());
  return glm::max(0.0f, 1 - (coat_f0_ * single.scale + coat_f90_ * single.bias + coat_multiple_ * lost));
}

/// Base and multiple scattering: everything that is sampled by the cosine. Without the factor cos / pi.
Vec3 OpaqueLobes::diffuse_like(float cosine_i) const {
  if (!has_specular_) return diffuse_;
  const GgxAlbedo::Split single = single_scattering(cosine_i);
  const Vec3 base = diffuse_ * left_by_coat(single);
  return is_delta_ ? base : base + multiple_ * glm::max(0.0f, 1 - single.total());
}

BsdfEval OpaqueLobes::eval_transmission(Vec3 wi, const ShadowTerminator& terminator) const {
  if (!(transmission_probability_ > 0)) return {};
  const float cosine_pdf = pdf_cosine_hemisphere(-wi.z);
  const float left_over = has_specular_ ? left_by_coat(single_scattering(-wi.z)) : 1.0f;
  return {transmitted_ * (left_over * cosine_pdf * terminator.factor(-wi)), transmission_probability_ * cosine_pdf};
}

BsdfEval OpaqueLobes::eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const {
  if (wi.z == 0 || wo.z <= 0) return {};
  if (wi.z < 0) return eval_transmission(wi, terminator);
  const float cosine_pdf = pdf_cosine_hemisphere(wi.z);
  const float broad_probability = glm::max(0.0f, 1 - specular_probability_ - transmission_probability_);
  BsdfEval result{diffuse_like(wi.z) * (cosine_pdf * terminator.factor(wi)), broad_probability * cosine_pdf};
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
    if (u_lobe < specular_probability_ + transmission_probability_) wi.z = -wi.z;
  }
  std::optional<BsdfSample> sample = sample_of(wi, eval(wo, wi, terminator));
  if (sample) sample->is_transmission = wi.z < 0;
  return sample;
}

}  // namespace candil
