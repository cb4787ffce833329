#include "materials/phong.h"

#include <cmath>

#include "core/frame.h"
#include "core/warp.h"

namespace candil {
namespace {

Vec3 mirror_direction(Vec3 wo) { return {-wo.x, -wo.y, wo.z}; }

/// cos^n of the angle between two unit vectors, 0 beyond 90 degrees. The distance between them tells small angles
/// better than their cosine.
float power_of_cosine(Vec3 a, Vec3 b, float exponent) {
  const float one_minus_cosine = 0.5f * length_squared(a - b);
  return one_minus_cosine < 1 ? std::exp(exponent * std::log1p(-one_minus_cosine)) : 0.0f;
}

/// A direction around `axis` with density (n + 1) / (2 pi) cos^n.
Vec3 sample_power_of_cosine(Vec3 axis, float exponent, Vec2 u) {
  // The cosine is (1 - u)^(1 / (n + 1)).
  const float one_minus_cosine = -std::expm1(std::log1p(-u.x) / (exponent + 1));
  const float sine = safe_sqrt(one_minus_cosine * (2 - one_minus_cosine)), phi = 2 * pi * u.y;
  return Frame(axis).to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - one_minus_cosine});
}

}  // namespace

PhongLobes::PhongLobes(const PhongParameters& p) : diffuse_(p.diffuse), specular_(p.specular), exponent_(p.exponent) {
  const float specular = max_component(specular_);
  survival_probability_ = max_component(diffuse_) + specular;
  specular_probability_ = specular / survival_probability_;
}

BsdfEval PhongLobes::eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const {
  if (wi.z <= 0 || wo.z <= 0) return {};
  const float cosine_pdf = pdf_cosine_hemisphere(wi.z);
  BsdfEval result{diffuse_ * (cosine_pdf * terminator.factor(wi)), (1 - specular_probability_) * cosine_pdf};
  if (!is_delta()) {
    const float lobe = power_of_cosine(mirror_direction(wo), wi, exponent_) / (2 * pi);
    result.f_cos += specular_ * ((exponent_ + 2) * lobe * wi.z);
    result.pdf += specular_probability_ * (exponent_ + 1) * lobe;
  }
  return result;
}

std::optional<BsdfSample> PhongLobes::sample(Vec3 wo, float u_lobe, Vec2 u_direction,
                                             const ShadowTerminator& terminator) const {
  if (wo.z <= 0) return std::nullopt;
  Vec3 wi;
  if (u_lobe < specular_probability_) {
    if (is_delta()) return mirror_sample(wo, specular_, specular_probability_);
    wi = sample_power_of_cosine(mirror_direction(wo), exponent_, u_direction);
  } else {
    wi = sample_cosine_hemisphere(u_direction);
  }
  return sample_of(wi, eval(wo, wi, terminator));
}

}  // namespace candil
