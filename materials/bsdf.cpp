#include "materials/bsdf.h"

#include "core/warp.h"

namespace candil {

BsdfEval Bsdf::eval(Vec3 wo, Vec3 wi) const {
  if (is_lambertian_) {
    const float cosine = glm::dot(wi, frame_.normal);
    if (!(cosine > 0 && glm::dot(wi, geometric_normal_) > 0)) return {};
    const float pdf = pdf_cosine_hemisphere(cosine);
    return {diffuse_ * pdf, pdf};
  }
  const Vec3 local_o = frame_.to_local(wo), local_i = frame_.to_local(wi);
  if (!sides_agree(wi, local_i.z)) return {};
  if (dielectric_weight_ == 0) return opaque_->eval(local_o, local_i);
  const BsdfEval transmitting = dielectric_->eval(local_o, local_i);
  if (dielectric_weight_ == 1) return transmitting;
  const BsdfEval reflecting = opaque_->eval(local_o, local_i);
  return {glm::mix(reflecting.f_cos, transmitting.f_cos, dielectric_weight_),
          glm::mix(reflecting.pdf, transmitting.pdf, dielectric_weight_)};
}

std::optional<BsdfSample> Bsdf::sample_lambertian(Vec2 u) const {
  std::optional<BsdfSample> result;
  const Vec3 local = sample_cosine_hemisphere(u);
  const Vec3 wi = frame_.to_world(local);
  if (!(local.z > 0 && glm::dot(wi, geometric_normal_) > 0)) return result;
  BsdfSample& sample = result.emplace();
  sample.wi = wi;
  sample.weight = diffuse_;
  sample.pdf = pdf_cosine_hemisphere(local.z);
  return result;
}

std::optional<BsdfSample> Bsdf::sample(Vec3 wo, float u_lobe, Vec2 u_direction) const {
  if (is_lambertian_) return sample_lambertian(u_direction);
  const Vec3 local_o = frame_.to_local(wo);
  const bool takes_dielectric = u_lobe < dielectric_weight_;
  const float probability = takes_dielectric ? dielectric_weight_ : 1 - dielectric_weight_;
  const float u = (takes_dielectric ? u_lobe : u_lobe - dielectric_weight_) / probability;
  const float u_rest = glm::min(u, one_minus_epsilon);
  std::optional<BsdfSample> sample = takes_dielectric ? dielectric_->sample(local_o, u_rest, u_direction)
                                                      : opaque_->sample(local_o, u_rest, u_direction);
  if (!sample) return std::nullopt;
  const Vec3 local_i = sample->wi;
  sample->wi = frame_.to_world(local_i);
  if (!sides_agree(sample->wi, local_i.z)) return std::nullopt;
  if (probability < 1) {
    if (sample->is_delta) {
      sample->pdf *= probability;  // the weight of the choice and of the lobe cancel
    } else {
      const BsdfEval other = takes_dielectric ? opaque_->eval(local_o, local_i) : dielectric_->eval(local_o, local_i);
      const float pdf = probability * sample->pdf + (1 - probability) * other.pdf;
      const Vec3 f_cos = probability * sample->pdf * sample->weight + (1 - probability) * other.f_cos;
      sample->weight = f_cos / pdf;
      sample->pdf = pdf;
    }
  }
  return sample;
}

bool Bsdf::has_only_delta_lobes() const {
  return (dielectric_weight_ == 1 || opaque_->is_purely_delta()) &&
         (dielectric_weight_ == 0 || dielectric_->is_purely_delta());
}

Vec3 Bsdf::albedo() const {
  if (is_lambertian_) return diffuse_;
  const Vec3 reflecting = opaque_ ? opaque_->albedo() : Vec3(0);
  return dielectric_ ? glm::mix(reflecting, dielectric_->albedo(), dielectric_weight_) : reflecting;
}

}  // namespace candil
