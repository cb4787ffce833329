#include "materials/opaque.h"

#include "core/color.h"
#include "core/warp.h"
#include "materials/fresnel.h"
#include "materials/ggx.h"

namespace candil {

template <typename Facets>
BasicOpaqueLobes<Facets>::BasicOpaqueLobes(const OpaqueParameters& p, const Facets& facets, Vec3 wo)
    : facets_(facets),
      f0_(glm::mix(p.coat_f0, p.base, p.metallic)),
      f90_(glm::mix(p.coat_f90, Vec3(1), p.metallic)),
      diffuse_((1 - p.metallic) * (1 - p.diffuse_transmission) * p.base),
      transmitted_((1 - p.metallic) * p.diffuse_transmission * p.transmission_color),
      coat_f0_(max_component(p.coat_f0)),
      coat_f90_(max_component(p.coat_f90)),
      albedo_(diffuse_ + transmitted_) {
  const float energy_through = luminance(transmitted_);
  if (energy_through > 0) transmission_probability_ = energy_through / (energy_through + luminance(diffuse_));
  [[maybe_unused]] FilmCurve<Vec3> film_curve;
  if constexpr (Facets::is_extended) {
    if (facets.film) {
      film_.emplace(facets.film, p.coat_f0, p.coat_f90, p.base, p.metallic);
      film_curve = film_->mixture(), film_coat_ = film_->greatest_of_coat();
      f0_ = film_curve.f0, f90_ = film_curve.f90;
      coat_f0_ = film_coat_.f0, coat_f90_ = film_coat_.f90;
    }
  }
  has_specular_ = max_component(glm::max(f0_, f90_)) > 0;
  if (!has_specular_) return;
  is_delta_ = facets_.is_smooth();
  if (is_delta_) facets_.make_smooth();
  const GgxAlbedo::Split single = single_scattering(wo);
  const GgxAlbedo::Split mean = facets_.average();
  Vec3 specular = f0_ * single.scale + f90_ * single.bias;
  float mean_coat = coat_f0_ * mean.scale + coat_f90_ * mean.bias;
  if constexpr (Facets::is_extended) {
    if (film_) {
      specular = is_delta_ ? film_->reflectance(wo.z) : specular + film_curve.deviation(facets_.directional_nodes(wo));
      mean_coat = is_delta_ ? film_coat_.mean() : mean_coat + film_coat_.deviation(facets_.average_nodes());
    }
  }
  if (!is_delta_) {
    const float lost = glm::max(0.0f, 1 - single.total()), mean_lost = glm::max(1e-6f, 1 - mean.total());
    // Unlike the single-scattering lobe, this one is not linear in f0: metal and coat each have their own colour.
    const auto color = [&](Vec3 mean_fresnel) { return multiple_scattering_color(mean_fresnel, mean.total()); };
    Vec3 coat = fresnel_schlick_average(p.coat_f0, p.coat_f90), metal = fresnel_schlick_average(p.base, Vec3(1));
    Vec3 greatest_coat = fresnel_schlick_average(Vec3(coat_f0_), Vec3(coat_f90_));
    if constexpr (Facets::is_extended) {
      if (film_) coat = film_->coat().mean(), metal = film_->metal().mean(), greatest_coat = Vec3(film_coat_.mean());
    }
    multiple_ = glm::mix(color(coat), color(metal), p.metallic) * (lost / mean_lost);
    coat_multiple_ = color(greatest_coat).x;
  }
  if (!is_black(diffuse_) || !is_black(transmitted_)) {
    const float towards_wo = coat_albedo(wo, single) + coat_multiple_ * (1 - single.total());
    const float on_average = mean_coat + coat_multiple_ * (1 - mean.total());
    const float left_over = glm::max(0.0f, 1 - towards_wo) / glm::max(1e-6f, 1 - on_average);
    diffuse_ *= left_over;
    transmitted_ *= left_over;
  }
  // Choose lobes by the energy that each returns towards wo.
  const float to_base = glm::max(0.0f, 1 - mean_coat);
  const Vec3 broad = multiple_ * (1 - mean.total()) + diffuse_ * to_base, through = transmitted_ * to_base;
  const float specular_energy = luminance(specular), through_energy = luminance(through);
  const float other_energy = luminance(broad) + through_energy;
  specular_probability_ = other_energy > 0 ? specular_energy / (specular_energy + other_energy) : 1.0f;
  transmission_probability_ = through_energy > 0 ? through_energy / (specular_energy + other_energy) : 0.0f;
  if constexpr (Facets::is_extended) {
    const float multiple_energy = luminance(multiple_ * (1 - mean.total()));
    if (multiple_energy > 0) multiple_probability_ = multiple_energy / (specular_energy + other_energy);
  }
  albedo_ = glm::min(specular + broad + through, Vec3(1));
}

template <typename Facets>
GgxAlbedo::Split BasicOpaqueLobes<Facets>::single_scattering(Vec3 w) const {
  if (!is_delta_) return facets_.directional(w);
  const float schlick = fresnel_schlick(Vec3(0), Vec3(1), w.z).x;
  return {1 - schlick, schlick};
}

template <typename Facets>
Vec3 BasicOpaqueLobes<Facets>::reflectance(float cosine) const {
  if constexpr (Facets::is_extended) {
    if (film_) return film_->reflectance(cosine);
  }
  return fresnel_schlick(f0_, f90_, cosine);
}

template <typename Facets>
float BasicOpaqueLobes<Facets>::coat_albedo(Vec3 w, const GgxAlbedo::Split& single) const {
  const float schlick = coat_f0_ * single.scale + coat_f90_ * single.bias;
  if constexpr (Facets::is_extended) {
    if (film_ && is_delta_) return film_->greatest_of_coat(w.z);
    if (film_) return schlick + film_coat_.deviation(facets_.directional_nodes(w));
  }
  return schlick;
}

template <typename Facets>
float BasicOpaqueLobes<Facets>::left_by_coat(Vec3 w, const GgxAlbedo::Split& single) const {
  const float lost = is_delta_ ? 0.0f : glm::max(0.0f, 1 - single.total());
  return glm::max(0.0f, 1 - (coat_albedo(w, single) + coat_multiple_ * lost));
}

/// Base and multiple scattering: everything that is sampled by the cosine. Without the factor cos / pi.
template <typename Facets>
Vec3 BasicOpaqueLobes<Facets>::diffuse_like(Vec3 wi) const {
  if (!has_specular_) return diffuse_;
  const GgxAlbedo::Split single = single_scattering(wi);
  const Vec3 base = diffuse_ * left_by_coat(wi, single);
  return is_delta_ ? base : base + multiple_ * glm::max(0.0f, 1 - single.total());
}

template <typename Facets>
BsdfEval BasicOpaqueLobes<Facets>::eval_transmission(Vec3 wi, const ShadowTerminator& terminator) const {
  if (!(transmission_probability_ > 0)) return {};
  const float cosine_pdf = pdf_cosine_hemisphere(-wi.z);
  const float left_over = has_specular_ ? left_by_coat(-wi, single_scattering(-wi)) : 1.0f;
  return {transmitted_ * (left_over * cosine_pdf * terminator.factor(-wi)), transmission_probability_ * cosine_pdf};
}

template <typename Facets>
BsdfEval BasicOpaqueLobes<Facets>::eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const {
  if (wi.z == 0 || wo.z <= 0) return {};
  if (wi.z < 0) return eval_transmission(wi, terminator);
  const float cosine_pdf = pdf_cosine_hemisphere(wi.z);
  const float broad_probability = glm::max(0.0f, 1 - specular_probability_ - transmission_probability_);
  BsdfEval result{diffuse_like(wi) * (cosine_pdf * terminator.factor(wi)), broad_probability * cosine_pdf};
  if (has_specular_ && !is_delta_) {
    const GgxReflection facets = ggx_reflection(wo, wi, facets_.alpha);
    result.f_cos += reflectance(facets.cosine) * facets.value;
    result.pdf += specular_probability_ * facets.pdf;
    if constexpr (Facets::is_extended) {
      result.pdf += multiple_probability_ * (facets_.pdf_multiple(wi.z) - cosine_pdf);
    }
  }
  return result;
}

template <typename Facets>
std::optional<BsdfSample> BasicOpaqueLobes<Facets>::sample(Vec3 wo, float u_lobe, Vec2 u_direction,
                                                           const ShadowTerminator& terminator) const {
  if (wo.z <= 0) return std::nullopt;
  Vec3 wi;
  if (u_lobe < specular_probability_) {
    if (is_delta_) return mirror_sample(wo, reflectance(wo.z), specular_probability_);
    wi = sample_ggx_reflection(wo, facets_.alpha, u_direction);
    if (wi.z <= 0) return std::nullopt;  // shadowed: not what the other lobes transmit
  } else {
    u_lobe -= specular_probability_;
    if (Facets::is_extended && u_lobe < multiple_probability_) {
      wi = facets_.sample_multiple(u_direction);
    } else {
      wi = sample_cosine_hemisphere(u_direction);
      if (u_lobe < multiple_probability_ + transmission_probability_) wi.z = -wi.z;
    }
  }
  std::optional<BsdfSample> sample = sample_of(wi, eval(wo, wi, terminator));
  if (sample) sample->is_transmission = wi.z < 0;
  return sample;
}

template class BasicOpaqueLobes<PlainFacets>;
template class BasicOpaqueLobes<ExtendedFacets>;

}  // namespace candil
