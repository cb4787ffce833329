#include "materials/clearcoat.h"

#include "materials/ggx.h"

namespace candil {
ClearcoatLobe::ClearcoatLobe(const ClearcoatParameters& p, const GradedGgxAlbedo& table, Vec3 wo)
    : frame_(p.normal), weight_(p.weight), alpha_(sqr(p.roughness)), is_delta_(alpha_ < ggx_min_alpha) {
  const float cosine = glm::dot(p.normal, wo);
  if (is_delta_) {
    albedo_ = weight_ * clearcoat_reflectance(cosine);
  } else {
    const GgxAlbedo::Split single = table.directional(p.roughness, cosine);
    albedo_ = weight_ * (clearcoat_f0 * single.scale + single.bias);
  }
}

BsdfEval ClearcoatLobe::eval(Vec3 wo, Vec3 wi) const {
  const Vec3 local_o = frame_.to_local(wo), local_i = frame_.to_local(wi);
  if (is_delta_ || local_o.z <= 0 || local_i.z <= 0) return {};
  const GgxReflection facets = ggx_reflection(local_o, local_i, alpha_);
  return {Vec3(weight_ * clearcoat_reflectance(facets.cosine) * facets.value), facets.pdf};
}

std::optional<BsdfSample> ClearcoatLobe::sample(Vec3 wo, Vec2 u) const {
  const Vec3 local_o = frame_.to_local(wo);
  if (local_o.z <= 0) return std::nullopt;
  if (is_delta_) {
    BsdfSample mirrored = mirror_sample(local_o, Vec3(albedo_), 1);
    mirrored.wi = frame_.to_world(mirrored.wi);
    return mirrored;
  }
  const Vec3 wi = frame_.to_world(sample_ggx_reflection(local_o, alpha_, u));
  return sample_of(wi, eval(wo, wi));
}

}  // namespace candil
