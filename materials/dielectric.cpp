#include "materials/dielectric.h"

#include "core/color.h"
#include "core/warp.h"
#include "materials/clearcoat.h"
#include "materials/fresnel.h"
#include "materials/ggx.h"

namespace candil {
namespace {

float brightness(float energy) { return energy; }
float brightness(Vec3 energy) { return luminance(energy); }

/// Sum of `values` with the weights of the nodes.
template <typename Nodes, typename Values>
Vec3 weighted_sum(const Nodes& nodes, const Values& values) {
  Vec3 sum(0);
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += nodes[i] * values[i];
  return sum;
}

}  // namespace

template <typename Facets>
BasicDielectricLobes<Facets>::BasicDielectricLobes(const DielectricParameters& p, const Facets& facets, Vec3 wo)
    : facets_(facets),
      is_thin_(p.is_thin),
      from_inside_(p.from_inside),
      reflects_all_(p.ior == 0),
      tint_(p.tint),
      f0_(p.f0),
      f90_(p.f90),
      coat_beyond_(p.coat_beyond) {
  eta_ = reflects_all_ ? 1.0f : from_inside_ ? 1 / p.ior : p.ior;
  reflecting_eta_ = reflects_all_ ? 1.0f : from_inside_ ? 1 / p.reflecting_ior : p.reflecting_ior;
  has_exact_fresnel_ = f90_ == Vec3(1) && f0_ == Vec3(reflectance_of_ior(p.reflecting_ior));
  is_delta_ = facets_.is_smooth() || (!is_thin_ && !reflects_all_ && is_index_matched(eta_));
  if (is_delta_) return;
  if (refracts()) reshape();
  lost_ = lost_energy(wo, Side::here);
  mean_lost_here_ = mean_lost_energy(Side::here);
  mean_lost_beyond_ = mean_lost_energy(Side::beyond);
  if (!refracts()) {
    multiple_transmitted_ = Energy(reflects_all_ ? 0 : 1 - luminance(mean_reflectance()));
  } else {
    const Energy beyond = mean_lost_beyond_ * sqr(reflecting_eta_);
    multiple_transmitted_ = beyond / (beyond + mean_lost_here_);
  }
  broad_probability_ = brightness(lost_);
  broad_transmission_probability_ = brightness(multiple_transmitted_);
}

/// A film changes the ends of the curve too: at grazing incidence it reflects everything.
template <typename Facets>
void BasicDielectricLobes<Facets>::reshape() {
  if constexpr (Facets::is_extended) {
    is_reshaped_ = !has_exact_fresnel_ && facets_.may_be_reshaped();
    if (is_reshaped_) {
      const float exact_f0 = sqr((reflecting_eta_ - 1) / (reflecting_eta_ + 1));
      const float share = facets_.film ? facets_.film.share : 0.0f;
      const Vec3 f0 = glm::mix(f0_, Vec3(exact_f0), share), f90 = glm::mix(f90_, Vec3(1), share);
      reshaped_factor_ = (f90 - f0) / (1 - exact_f0);
      reshaped_constant_ = f0 - exact_f0 * reshaped_factor_;
    }
    if (facets_.film) add_film();
  }
}

template <typename Facets>
void BasicDielectricLobes<Facets>::add_film() {
  if constexpr (Facets::is_extended) {
    for (int i = 0; i < FilmedDielectricAlbedo::node_count; ++i) {
      const float in_rarer = FilmedDielectricAlbedo::cosine(i);
      const float cosine = eta_ < 1 ? glm::sqrt(1 - (1 - sqr(in_rarer)) * sqr(eta_)) : in_rarer;
      film_nodes_[static_cast<std::size_t>(i)] =
          reflectance_without_coat(cosine) -
          (reshaped_constant_ + reshaped_factor_ * fresnel_dielectric(cosine, reflecting_eta_));
    }
  }
}

template <typename Facets>
Vec3 BasicDielectricLobes<Facets>::reflectance_without_film(float cosine) const {
  if (reflects_all_) return Vec3(1);
  const float exact = fresnel_dielectric(cosine, reflecting_eta_);
  if (has_exact_fresnel_ || exact >= 1) return Vec3(exact);
  const float f0 = sqr((reflecting_eta_ - 1) / (reflecting_eta_ + 1));
  return glm::clamp(f0_ + (f90_ - f0_) * ((exact - f0) / (1 - f0)), 0.0f, 1.0f);
}

template <typename Facets>
Vec3 BasicDielectricLobes<Facets>::reflectance(float cosine) const {
  const Vec3 own = reflectance_without_coat(cosine);
  if (!Facets::is_extended || coat_beyond_ == 0) return own;
  const float cosine_beyond = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(eta_));
  return own + (1.0f - own) * (coat_beyond_ * clearcoat_reflectance(cosine_beyond));
}

template <typename Facets>
Vec3 BasicDielectricLobes<Facets>::reflectance_without_coat(float cosine) const {
  const Vec3 bare = reflectance_without_film(cosine);
  if constexpr (Facets::is_extended) {
    if (facets_.film && !reflects_all_) return glm::mix(bare, film_reflectance(cosine), facets_.film.share);
  }
  return bare;
}

/// A film looks the same from both of its sides, at angles that refraction makes correspond.
template <typename Facets>
Vec3 BasicDielectricLobes<Facets>::film_reflectance(float cosine) const {
  if constexpr (Facets::is_extended) {
    const float squared = from_inside_ ? 1 - (1 - sqr(cosine)) / sqr(eta_) : sqr(cosine);
    if (!(squared > 0)) return Vec3(1);
    const Vec3 base_ior =
        has_exact_fresnel_ ? Vec3(from_inside_ ? 1 / reflecting_eta_ : reflecting_eta_) : ior_of_reflectance(f0_);
    return film_reflectance_on_dielectric(facets_.film, base_ior, glm::sqrt(squared));
  } else {
    return Vec3(0);
  }
}

template <typename Facets>
Vec3 BasicDielectricLobes<Facets>::mean_reflectance() const {
  if constexpr (Facets::is_extended) {
    if (facets_.film) {
      constexpr int count = 8;  // midpoints in the squared cosine
      Vec3 sum(0);
      for (int i = 0; i < count; ++i) sum += reflectance(glm::sqrt((static_cast<float>(i) + 0.5f) / count));
      return sum / static_cast<float>(count);
    }
  }
  return fresnel_schlick_average(f0_, f90_);
}

template <typename Facets>
float BasicDielectricLobes<Facets>::reflection_probability(Vec3 facet_reflectance) const {
  const float reflected = luminance(facet_reflectance);
  const float transmitted = luminance((1.0f - facet_reflectance) * tint_);
  return transmitted > 0 ? reflected / (reflected + transmitted) : 1.0f;
}

/// By the curve of reshaped_constant_ and reshaped_factor_, and a coat beyond it. `by_coat`: of what the coat adds to
/// the exact curve.
template <typename Facets>
Vec3 BasicDielectricLobes<Facets>::more_lost(Side side, const ReshapedDielectric& reshaped, float by_coat) const {
  const Vec3 constant(reshaped_constant_), factor(reshaped_factor_);
  const Vec3 by_facets = constant * reshaped.by_constant + (factor - 1.0f) * reshaped.by_exact;
  if (side == Side::beyond) return by_facets;
  return by_facets - coat_beyond_ * ((1.0f - constant - factor) * reshaped.by_coat + (factor - 1.0f) * by_coat);
}

template <typename Facets>
auto BasicDielectricLobes<Facets>::lost_energy(Vec3 w, Side side) const -> Energy {
  const bool is_inside = from_inside_ == (side == Side::here);
  float kept = refracts() ? facets_.dielectric_directional(w, is_inside)
                          : facets_.directional(Vec3(w.x, w.y, std::abs(w.z))).total();
  if constexpr (Facets::is_extended) {
    const float by_coat = coat_beyond_ > 0 && side == Side::here && refracts() ? facets_.directional_by_coat(w) : 0.0f;
    kept += coat_beyond_ * by_coat;
    if (is_reshaped_ || (facets_.film && refracts())) {
      Vec3 lost(1 - kept);
      if (is_reshaped_) lost += more_lost(side, facets_.directional_reshaped(w, is_inside), by_coat);
      if (facets_.film) lost += weighted_sum(facets_.film_directional(w, is_inside), film_nodes_);
      return glm::clamp(lost, 0.0f, 1.0f);
    }
  }
  return Energy(glm::max(0.0f, 1 - kept));
}

/// Over the cosine-weighted hemisphere.
template <typename Facets>
auto BasicDielectricLobes<Facets>::mean_lost_energy(Side side) const -> Energy {
  const bool is_inside = from_inside_ == (side == Side::here);
  float kept = refracts() ? facets_.dielectric_average(is_inside) : facets_.average().total();
  if constexpr (Facets::is_extended) {
    const float by_coat = coat_beyond_ > 0 && side == Side::here && refracts() ? facets_.average_by_coat() : 0.0f;
    kept += coat_beyond_ * by_coat;
    if (is_reshaped_ || (facets_.film && refracts())) {
      Vec3 lost(1 - kept);
      if (is_reshaped_) lost += more_lost(side, facets_.average_reshaped(is_inside), by_coat);
      if (facets_.film) lost += weighted_sum(facets_.film_average(is_inside), film_nodes_);
      return glm::max(lost, 1e-6f);
    }
  }
  return Energy(glm::max(1e-6f, 1 - kept));
}

template <typename Facets>
BsdfEval BasicDielectricLobes<Facets>::eval_facets(Vec3 wo, Vec3 wi) const {
  const bool is_reflection = wi.z > 0;
  if (is_reflection || is_thin_) {
    const Vec3 mirrored(wi.x, wi.y, std::abs(wi.z));
    const Vec3 h = glm::normalize(wo + mirrored);
    const float density = ggx_distribution(h, facets_.alpha) / (4 * wo.z);
    const Vec3 fresnel = reflectance(glm::dot(wo, h));
    const float probability = reflection_probability(fresnel);
    return {(is_reflection ? fresnel : (1.0f - fresnel) * tint_) *
                (density * ggx_masking_shadowing(wo, mirrored, facets_.alpha)),
            (is_reflection ? probability : 1 - probability) * density * ggx_masking(wo, facets_.alpha)};
  }
  if (reflects_all_) return {};
  // The facet that refracts wo into wi (Walter et al. 2007, equation 16), turned to the outside.
  Vec3 h = glm::normalize(wo + eta_ * wi);
  if (h.z < 0) h = -h;
  const float cos_o = glm::dot(wo, h), cos_i = glm::dot(wi, h);
  if (cos_o <= 0 || cos_i >= 0) return {};
  const Vec3 fresnel = reflectance(cos_o);
  const float distribution = ggx_distribution(h, facets_.alpha);
  const float jacobian = -cos_i / sqr(cos_i + cos_o / eta_);  // d(h) / d(wi)
  const float density = distribution * cos_o / wo.z * jacobian;
  return {(1.0f - fresnel) * tint_ * (density * ggx_masking_shadowing(wo, wi, facets_.alpha) / sqr(eta_)),
          (1 - reflection_probability(fresnel)) * density * ggx_masking(wo, facets_.alpha)};
}

template <typename Facets>
BsdfEval BasicDielectricLobes<Facets>::eval_multiple(Vec3 wi) const {
  const float cosine = std::abs(wi.z), cosine_pdf = pdf_cosine_hemisphere(cosine);
  const float pdf = facets_.pdf_multiple(cosine);
  if (wi.z > 0) {
    const Energy share = 1.0f - multiple_transmitted_;
    const Energy value = share * lost_ * lost_energy(wi, Side::here) / mean_lost_here_ * cosine_pdf;
    return {Vec3(value), broad_probability_ * (1 - broad_transmission_probability_) * pdf};
  }
  const float radiance_scale = is_thin_ ? 1.0f : 1 / sqr(eta_);
  const Energy value = multiple_transmitted_ * lost_ * lost_energy(wi, Side::beyond) / mean_lost_beyond_ * cosine_pdf;
  return {tint_ * (value * radiance_scale), broad_probability_ * broad_transmission_probability_ * pdf};
}

template <typename Facets>
BsdfEval BasicDielectricLobes<Facets>::eval(Vec3 wo, Vec3 wi) const {
  if (is_delta_ || wo.z <= 0 || wi.z == 0) return {};
  const BsdfEval facets = eval_facets(wo, wi), multiple = eval_multiple(wi);
  return {facets.f_cos + multiple.f_cos, (1 - broad_probability_) * facets.pdf + multiple.pdf};
}

template <typename Facets>
std::optional<BsdfSample> BasicDielectricLobes<Facets>::sample_delta(Vec3 wo, float u_lobe) const {
  const Vec3 fresnel = reflectance(wo.z);
  const float probability = reflection_probability(fresnel);
  BsdfSample result;
  result.is_delta = true;
  if (u_lobe < probability) {
    result.wi = {-wo.x, -wo.y, wo.z};
    result.weight = fresnel / probability;
    result.pdf = probability;
    return result;
  }
  result.is_transmission = true;
  result.pdf = 1 - probability;
  result.eta = is_thin_ ? 1.0f : eta_;
  result.wi = is_thin_ ? -wo : refract(wo, Vec3(0, 0, 1), eta_);
  result.weight = (1.0f - fresnel) * tint_ / (result.pdf * sqr(result.eta));
  return result;
}

template <typename Facets>
std::optional<BsdfSample> BasicDielectricLobes<Facets>::sample(Vec3 wo, float u_lobe, Vec2 u_direction) const {
  if (wo.z <= 0) return std::nullopt;
  if (is_delta_) return sample_delta(wo, u_lobe);
  BsdfSample result;
  if (u_lobe < broad_probability_) {
    result.wi = facets_.sample_multiple(u_direction);
    if (u_lobe < broad_probability_ * broad_transmission_probability_) result.wi.z = -result.wi.z;
  } else {
    const float u = glm::min((u_lobe - broad_probability_) / (1 - broad_probability_), one_minus_epsilon);
    const Vec3 h = sample_ggx_visible(wo, facets_.alpha, u_direction);
    const float cosine = glm::dot(wo, h);
    if (cosine <= 0) return std::nullopt;
    const Vec3 fresnel = reflectance(cosine);
    const bool is_reflection = u < reflection_probability(fresnel);
    if (is_reflection || is_thin_) {
      result.wi = 2 * cosine * h - wo;
      if (result.wi.z <= 0) return std::nullopt;
      if (!is_reflection) result.wi.z = -result.wi.z;
    } else {
      result.wi = refract(wo, h, eta_);
      if (result.wi.z >= 0) return std::nullopt;
    }
  }
  const BsdfEval value = eval(wo, result.wi);
  if (!(value.pdf > 0)) return std::nullopt;
  result.weight = value.f_cos / value.pdf;
  result.pdf = value.pdf;
  result.is_transmission = result.wi.z < 0;
  result.eta = result.is_transmission && !is_thin_ ? eta_ : 1.0f;
  return result;
}

template class BasicDielectricLobes<PlainFacets>;
template class BasicDielectricLobes<ExtendedFacets>;

}  // namespace candil
