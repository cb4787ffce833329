#include "materials/bsdf.h"

namespace candil {

BsdfEval Bsdf::eval(Vec3 wo, Vec3 wi) const {
  const Vec3 local_o = frame_.to_local(wo), local_i = frame_.to_local(wi);
  if (!sides_agree(wi, local_i.z)) return {};
  if (dielectric_weight_ == 0) return opaque_->eval(local_o, local_i);
  const BsdfEval transmitting = dielectric_->eval(local_o, local_i);
  if (dielectric_weight_ == 1) return transmitting;
  const BsdfEval reflecting = opaque_->eval(local_o, local_i);
  return {glm::mix(reflecting.f_cos, transmitting.f_cos, dielectric_weight_),
          glm::mix(reflecting.pdf, transmitting.pdf, dielectric_weight_)};
}

std::optional<BsdfSample> Bsdf::sample(Vec3 wo, float u_lobe, Vec2 u_direction) const {
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

bool Bsdf::is_purely_delta() const {
  return (dielectric_weight_ == 1 || opaque_->is_purely_delta()) &&
         (dielectric_weight_ == 0 || dielectric_->is_purely_delta());
}

Vec3 Bsdf::albedo() const {
  const Vec3 reflecting = opaque_ ? opaque_->albedo() : Vec3(0);
  return dielectric_ ? glm::mix(reflecting, dielectric_->albedo(), dielectric_weight_) : reflecting;
}

}  // namespace candil
