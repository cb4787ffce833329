/// The GGX microfacet distribution with Smith's height-correlated masking and shadowing (Walter et al. 2007, Heitz
/// 2014), isotropic or anisotropic. Local frame: z is the surface normal. `alpha` is the square of the perceptual
/// roughness; of an anisotropic surface those along x and y.
#pragma once

#include <cmath>

#include "core/math.h"

namespace candil {

/// Below this alpha the lobe is a mirror: a delta distribution.
inline constexpr float ggx_min_alpha = 1e-3f;

/// Density of facet normals; 1/sr, projected to the surface it integrates to 1.
inline float ggx_distribution(Vec3 h, float alpha) {
  const float a2 = sqr(alpha);
  // 1 - h.z^2 from x and y keeps its digits where the peak is narrow.
  const float t = sqr(h.x) + sqr(h.y) + a2 * sqr(h.z);
  return a2 / (pi * sqr(t));
}

inline float ggx_distribution(Vec3 h, Vec2 alpha) {
  const float product = alpha.x * alpha.y;
  // The facet in the space where the surface has the roughness 1, times that product.
  const float t = sqr(alpha.y * h.x) + sqr(alpha.x * h.y) + sqr(product * h.z);
  return product * sqr(product) / (pi * sqr(t));
}

/// Smith's lambda: masked area per visible area.
inline float ggx_lambda(Vec3 w, float alpha) {
  const float cos2 = sqr(w.z);
  if (cos2 == 0) return infinity;
  return 0.5f * (glm::sqrt(1 + sqr(alpha) * (sqr(w.x) + sqr(w.y)) / cos2) - 1);
}

inline float ggx_lambda(Vec3 w, Vec2 alpha) {
  const float cos2 = sqr(w.z);
  if (cos2 == 0) return infinity;
  return 0.5f * (glm::sqrt(1 + (sqr(alpha.x * w.x) + sqr(alpha.y * w.y)) / cos2) - 1);
}

// What follows is the same for an isotropic `alpha`, a float, and an anisotropic one, a Vec2.

/// Fraction of facets visible from w.
template <typename Alpha>
inline float ggx_masking(Vec3 w, Alpha alpha) {
  return 1 / (1 + ggx_lambda(w, alpha));
}

/// Visible from both; for directions on opposite sides too.
template <typename Alpha>
inline float ggx_masking_shadowing(Vec3 wo, Vec3 wi, Alpha alpha) {
  return 1 / (1 + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}

/// Single scattering from wo to wi by facets between them that reflect everything; wo.z > 0, wi.z > 0.
struct GgxReflection {
  float cosine;  ///< Of both directions with the facet.
  float value;   ///< f |cos|.
  float pdf;     ///< 1/sr, of sample_ggx_reflection().
};
template <typename Alpha>
inline GgxReflection ggx_reflection(Vec3 wo, Vec3 wi, Alpha alpha) {
  const Vec3 h = glm::normalize(wo + wi);
  const float density = ggx_distribution(h, alpha) / (4 * wo.z);  // d(h) / d(wi) = 1 / (4 wo.h)
  return {glm::dot(wo, h), density * ggx_masking_shadowing(wo, wi, alpha), density * ggx_masking(wo, alpha)};
}

/// A place on a spherical cap, of whatever height.
struct CapSample {
  Vec2 azimuth;  ///< Cosine and sine.
  float height;  ///< In (0, 1].

  CapSample() = default;
  explicit CapSample(Vec2 u) : azimuth(std::cos(2 * pi * u.x), std::sin(2 * pi * u.x)), height(1 - u.y) {}
};

/// A facet normal as seen from wo (wo.z > 0), with density G1(wo) D(h) max(0, wo.h) / wo.z per steradian (Dupuy and
/// Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps").
template <typename Alpha>
inline Vec3 sample_ggx_visible(Vec3 wo, Alpha alpha, const CapSample& u) {
  const Vec2 stretch(alpha);
  const Vec3 stretched = glm::normalize(Vec3(stretch.x * wo.x, stretch.y * wo.y, wo.z));
  const float z = u.height * (1 + stretched.z) - stretched.z;
  const float radius = safe_sqrt(1 - sqr(z));
  const Vec3 h = Vec3(radius * u.azimuth.x, radius * u.azimuth.y, z) + stretched;
  return glm::normalize(Vec3(stretch.x * h.x, stretch.y * h.y, glm::max(1e-9f, h.z)));
}
template <typename Alpha>
inline Vec3 sample_ggx_visible(Vec3 wo, Alpha alpha, Vec2 u) {
  return sample_ggx_visible(wo, alpha, CapSample(u));
}

/// wo mirrored at such a facet; may point below the surface. Its density is GgxReflection::pdf.
template <typename Alpha>
inline Vec3 sample_ggx_reflection(Vec3 wo, Alpha alpha, Vec2 u) {
  const Vec3 h = sample_ggx_visible(wo, alpha, u);
  return 2 * glm::dot(wo, h) * h - wo;
}

}  // namespace candil
