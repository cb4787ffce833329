#include "materials/layers.h"

#include "core/color.h"
#include "core/math.h"
#include "materials/shadow_terminator.h"

namespace candil {

Layers::Layers(const std::optional<ClearcoatLobe>& coat, const std::optional<SheenLobe>& sheen, Vec3 base_albedo)
    : coat_(coat), sheen_(sheen) {
  const float coat_albedo = coat ? coat->albedo() : 0.0f;
  sheen_scale_ = 1 - coat_albedo;
  base_scale_ = sheen ? sheen_scale_ * (1 - sheen->taken()) : sheen_scale_;
  const Vec3 sheen_albedo = sheen ? sheen_scale_ * sheen->albedo() : Vec3(0);
  albedo_ = coat_albedo + sheen_albedo;
  // By the energy that each returns towards wo.
  const float sheen_energy = luminance(sheen_albedo), base_energy = base_scale_ * luminance(base_albedo);
  const float energy = coat_albedo + sheen_energy + base_energy;
  coat_probability_ = energy > 0 ? coat_albedo / energy : 0.0f;
  sheen_probability_ = energy > 0 ? sheen_energy / energy : 0.0f;
  base_probability_ = glm::max(0.0f, 1 - coat_probability_ - sheen_probability_);
}

BsdfEval Layers::over(const BsdfEval& base, Vec3 wo, Vec3 wi, Vec3 normal_of_sides) const {
  BsdfEval result{base_scale_ * base.f_cos, base_probability_ * base.pdf};
  const float cosine_surface = glm::dot(wi, normal_of_sides);
  if (cosine_surface <= 0) return result;
  if (coat_) {
    const BsdfEval coat = coat_->eval(wo, wi);
    result.f_cos += coat.f_cos;
    result.pdf += coat_probability_ * coat.pdf;
  }
  if (sheen_) {
    const BsdfEval sheen = sheen_->eval(wo, wi);
    const Vec3 normal = sheen_->normal();
    const float fade = sheen.pdf > 0 ? ShadowTerminator::factor(glm::dot(wi, normal), cosine_surface,
                                                                glm::dot(normal, normal_of_sides))
                                     : 0.0f;
    result.f_cos += sheen_scale_ * fade * sheen.f_cos;
    result.pdf += sheen_probability_ * sheen.pdf;
  }
  return result;
}

Layers::Choice Layers::choose(float u_lobe) const {
  const auto rest = [](float u, float probability) { return glm::min(u / probability, one_minus_epsilon); };
  if (u_lobe < coat_probability_) return {Part::coat, coat_probability_, rest(u_lobe, coat_probability_)};
  u_lobe -= coat_probability_;
  if (u_lobe < sheen_probability_) return {Part::sheen, sheen_probability_, rest(u_lobe, sheen_probability_)};
  // May be 0 although rounding has left a number for it.
  const float u_rest = base_probability_ > 0 ? rest(u_lobe - sheen_probability_, base_probability_) : 0.0f;
  return {Part::base, base_probability_, u_rest};
}

}  // namespace candil
