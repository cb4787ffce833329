#include "materials/bsdf.h"

namespace candil {
namespace {

/// A refracted direction that came out on the wrong side of the surface, put just on the right one, where `normal` is:
/// it is bent rather than lost.
Vec3 bent_to_horizon(Vec3 w, Vec3 normal) {
  constexpr float least_cosine = 1e-3f;
  return glm::normalize(w + (least_cosine - glm::dot(w, normal)) * normal);
}

}  // namespace

template <typename Function>
auto Bsdf::with_reflecting(const Function& function) const {
  switch (kind_) {
    case Kind::phong:
      return function(*phong_);
    case Kind::conductor:
      return function(*conductor_);
    case Kind::extended_opaque:
      return function(*extended_opaque_);
    default:
      return function(*opaque_);
  }
}

ShadowTerminator Bsdf::shadow_terminator() const {
  return is_flat_ ? ShadowTerminator() : ShadowTerminator(frame_.to_local(normal_of_sides_));
}

BsdfEval Bsdf::eval_layered(Vec3 wo, Vec3 wi) const {
  const BsdfEval base = eval_base(wo, wi);
  return layers_ ? layers_->over(base, wo, wi, normal_of_sides_) : base;
}

BsdfEval Bsdf::eval_base(Vec3 wo, Vec3 wi) const {
  const Vec3 local_o = frame_.to_local(wo), local_i = frame_.to_local(wi);
  if (!sides_agree(wi, local_i.z)) return {};
  const auto eval_reflecting = [&](const auto& lobes) { return lobes.eval(local_o, local_i, shadow_terminator()); };
  if (dielectric_weight_ == 0) return with_reflecting(eval_reflecting);
  const auto eval_transmitting = [&](const auto& lobes) { return lobes.eval(local_o, local_i); };
  const BsdfEval transmitting = with_transmitting(eval_transmitting);
  if (dielectric_weight_ == 1) return transmitting;
  const BsdfEval reflecting = with_reflecting(eval_reflecting);
  return {glm::mix(reflecting.f_cos, transmitting.f_cos, dielectric_weight_),
          glm::mix(reflecting.pdf, transmitting.pdf, dielectric_weight_)};
}

std::optional<BsdfSample> Bsdf::sample_layered(Vec3 wo, float u_lobe, Vec2 u_direction) const {
  if (!layers_) return sample_base(wo, u_lobe, u_direction);
  const Layers::Choice choice = layers_->choose(u_lobe);
  if (!(choice.probability > 0)) return std::nullopt;
  const bool is_base = choice.part == Layers::Part::base;
  std::optional<BsdfSample> sample =
      is_base ? sample_base(wo, choice.u_rest, u_direction) : layers_->sample(choice.part, wo, u_direction);
  if (!sample) return std::nullopt;
  if (!is_base && glm::dot(sample->wi, normal_of_sides_) <= 0) {
    if (!sample->is_delta) return std::nullopt;
    sample->wi = bent_to_horizon(sample->wi, normal_of_sides_);
  }
  if (sample->is_delta) {
    sample->weight *= (is_base ? layers_->base_scale() : 1.0f) / choice.probability;
    sample->pdf *= choice.probability;
    return sample;
  }
  const BsdfEval base = is_base ? BsdfEval{sample->weight * sample->pdf, sample->pdf} : eval_base(wo, sample->wi);
  const BsdfEval all = layers_->over(base, wo, sample->wi, normal_of_sides_);
  sample->weight = all.f_cos / all.pdf;
  sample->pdf = all.pdf;
  return sample;
}

std::optional<BsdfSample> Bsdf::sample_base(Vec3 wo, float u_lobe, Vec2 u_direction) const {
  const Vec3 local_o = frame_.to_local(wo);
  const bool takes_dielectric = u_lobe < dielectric_weight_;
  const float probability = takes_dielectric ? dielectric_weight_ : 1 - dielectric_weight_;
  const float u = (takes_dielectric ? u_lobe : u_lobe - dielectric_weight_) / probability;
  const float u_rest = glm::min(u, one_minus_epsilon);
  std::optional<BsdfSample> sample;
  if (takes_dielectric) {
    sample = with_transmitting([&](const auto& lobes) { return lobes.sample(local_o, u_rest, u_direction); });
  } else {
    sample = with_reflecting(
        [&](const auto& lobes) { return lobes.sample(local_o, u_rest, u_direction, shadow_terminator()); });
  }
  if (!sample) return std::nullopt;
  const Vec3 local_i = sample->wi;
  sample->wi = frame_.to_world(local_i);
  if (!sides_agree(sample->wi, local_i.z)) {
    if (!sample->is_delta || local_i.z == 0) return std::nullopt;
    sample->wi = bent_to_horizon(sample->wi, local_i.z < 0 ? -normal_of_sides_ : normal_of_sides_);
  }
  if (probability < 1) {
    if (sample->is_delta) {
      sample->pdf *= probability;  // the weight of the choice and of the lobe cancel
    } else {
      const BsdfEval other =
          takes_dielectric
              ? with_reflecting([&](const auto& lobes) { return lobes.eval(local_o, local_i, shadow_terminator()); })
              : with_transmitting([&](const auto& lobes) { return lobes.eval(local_o, local_i); });
      const float pdf = probability * sample->pdf + (1 - probability) * other.pdf;
      const Vec3 f_cos = probability * sample->pdf * sample->weight + (1 - probability) * other.f_cos;
      sample->weight = f_cos / pdf;
      sample->pdf = pdf;
    }
  }
  return sample;
}

bool Bsdf::has_only_delta_lobes() const {
  if (layers_ && !layers_->is_purely_delta()) return false;
  const auto is_delta = [](const auto& lobes) { return lobes.is_purely_delta(); };
  return (dielectric_weight_ == 1 || with_reflecting(is_delta)) &&
         (dielectric_weight_ == 0 || with_transmitting(is_delta));
}

Vec3 Bsdf::albedo() const {
  const Vec3 base = base_albedo();
  return layers_ ? layers_->albedo() + layers_->base_scale() * base : base;
}

Vec3 Bsdf::base_albedo() const {
  if (kind_ == Kind::lambertian) return diffuse_;
  const auto albedo_of = [](const auto& lobes) { return lobes.albedo(); };
  if (dielectric_weight_ == 1) return with_transmitting(albedo_of);
  const Vec3 reflecting = with_reflecting(albedo_of);
  return dielectric_weight_ > 0 ? glm::mix(reflecting, with_transmitting(albedo_of), dielectric_weight_) : reflecting;
}

float Bsdf::survival_probability() const {
  const float base = base_survival_probability();
  return layers_ ? max_component(layers_->albedo()) + layers_->base_scale() * base : base;
}

float Bsdf::base_survival_probability() const {
  if (kind_ == Kind::lambertian) return max_component(diffuse_);
  if (dielectric_weight_ == 1) return 1;
  const float reflecting = with_reflecting([](const auto& lobes) { return lobes.survival_probability(); });
  return glm::mix(reflecting, 1.0f, dielectric_weight_);
}

}  // namespace candil
