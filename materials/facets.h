/// The facets of a rough interface: their distribution and how much light they return. The lobes are written once for
/// both kinds; nothing of the second kind is paid for by materials without these extensions.
#pragma once

#include <cmath>

#include "core/warp.h"
#include "materials/anisotropy.h"
#include "materials/ggx.h"
#include "materials/ggx_albedo.h"
#include "materials/graded_albedo.h"
#include "materials/thin_film.h"

namespace candil {

/// Isotropic, without a film.
struct PlainFacets {
  static constexpr bool is_extended = false;
  const GgxAlbedo* ggx = nullptr;
  const DielectricAlbedo* dielectric = nullptr;  ///< May be null where nothing is refracted by rough facets.
  float roughness = 1;                           ///< Perceptual.
  float alpha = 1;                               ///< For the functions of ggx.h.

  PlainFacets(float perceptual_roughness, const GgxAlbedo& table, const DielectricAlbedo* dielectric_table = nullptr)
      : ggx(&table), dielectric(dielectric_table), roughness(perceptual_roughness), alpha(sqr(perceptual_roughness)) {}

  /// So smooth that it is a mirror.
  bool is_smooth() const { return alpha < ggx_min_alpha; }
  void make_smooth() { roughness = 0; }
  GgxAlbedo::Split directional(Vec3 w) const { return ggx->directional(roughness, w.z); }
  GgxAlbedo::Split average() const { return ggx->average(roughness); }
  float dielectric_directional(Vec3 w, bool from_inside) const {
    return dielectric->directional(roughness, glm::abs(w.z), from_inside);
  }
  float dielectric_average(bool from_inside) const { return dielectric->average(roughness, from_inside); }
  bool has_dielectric_table() const { return dielectric != nullptr; }
  /// A direction, local, for light that was scattered between facets more than once.
  static Vec3 sample_multiple(Vec2 u) { return sample_cosine_hemisphere(u); }
  /// Its density, 1/sr.
  static float pdf_multiple(float cosine) { return pdf_cosine_hemisphere(cosine); }
};

/// Of materials with extensions: anisotropic (KHR_materials_anisotropy), under a thin film (KHR_materials_iridescence),
/// or below layers that need exact albedos. x is the direction of greater roughness.
struct ExtendedFacets {
  static constexpr bool is_extended = true;
  const GradedGgxAlbedo* ggx = nullptr;
  const GradedDielectricAlbedo* dielectric = nullptr;  ///< Null where nothing is refracted by rough facets.
  const AnisotropicAlbedo* anisotropic_ggx = nullptr;  ///< Null: isotropic.
  const AnisotropicDielectricAlbedo* anisotropic_dielectric = nullptr;
  const FacetAngles* angles = nullptr;                        ///< Not null if there is a film.
  const FilmedDielectricAlbedo* filmed_dielectric = nullptr;  ///< The same where something is refracted.
  float roughness = 1;  ///< Perceptual; of an anisotropic interface its geometric mean.
  Vec2 alpha{1.0f};
  float ior = 1.5f;  ///< Of the medium behind the front side.
  ThinFilm film;

  bool is_smooth() const { return alpha.x < ggx_min_alpha; }
  void make_smooth() { roughness = 0, anisotropic_ggx = nullptr; }
  GgxAlbedo::Split directional(Vec3 w) const {
    return anisotropic_ggx ? anisotropic_ggx->directional(alpha, w) : ggx->directional(roughness, glm::abs(w.z));
  }
  GgxAlbedo::Split average() const {
    return anisotropic_ggx ? anisotropic_ggx->average(alpha) : ggx->average(roughness);
  }
  float dielectric_directional(Vec3 w, bool from_inside) const {
    return anisotropic_dielectric ? anisotropic_dielectric->directional(alpha, w, from_inside)
                                  : dielectric->directional(ior, roughness, glm::abs(w.z), from_inside).kept;
  }
  float dielectric_average(bool from_inside) const {
    return anisotropic_dielectric ? anisotropic_dielectric->average(alpha, from_inside)
                                  : dielectric->average(ior, roughness, from_inside).kept;
  }
  /// What a clear coat of weight 1 beyond the interface adds to it, seen from inside.
  float directional_by_coat(Vec3 w) const {
    return dielectric->directional(ior, projected_roughness(w), glm::abs(w.z), true).by_coat;
  }
  float average_by_coat() const { return dielectric->average(ior, projected_roughness(Vec3(1, 1, 0)), true).by_coat; }
  /// Of both at once, where facets reflect otherwise than by Fresnel's equations.
  ReshapedDielectric directional_reshaped(Vec3 w, bool from_inside) const {
    ReshapedDielectric all = dielectric->directional_reshaped(ior, projected_roughness(w), glm::abs(w.z), from_inside);
    if (anisotropic_dielectric) {
      const Vec2 exact = anisotropic_dielectric->directional_reshaped(alpha, w, from_inside);
      all.by_constant = exact.x, all.by_exact = exact.y;
    }
    return all;
  }
  ReshapedDielectric average_reshaped(bool from_inside) const {
    ReshapedDielectric all = dielectric->average_reshaped(ior, projected_roughness(Vec3(1, 1, 0)), from_inside);
    if (anisotropic_dielectric) {
      const Vec2 exact = anisotropic_dielectric->average_reshaped(alpha, from_inside);
      all.by_constant = exact.x, all.by_exact = exact.y;
    }
    return all;
  }
  bool may_be_reshaped() const { return dielectric && dielectric->range().may_be_reshaped; }
  bool has_dielectric_table() const { return dielectric != nullptr; }
  /// What facets lose, and so what they return of it, falls with the square of the cosine from about `alpha` on. Chosen
  /// by the cosine alone, the light of nearly smooth surfaces would be found as rarely as it is bright; the logarithm
  /// of the cosine has the density of what is lost.
  Vec3 sample_multiple(Vec2 u) const {
    if (u.x < roughness) return sample_cosine_hemisphere({u.x / roughness, u.y});
    u.x = glm::min((u.x - roughness) / (1 - roughness), one_minus_epsilon);
    const float smallest = smallest_cosine();
    const float cosine = glm::min(smallest * std::expm1(u.x * std::log1p(1 / smallest)), 1.0f);
    const float sine = safe_sqrt(1 - sqr(cosine)), phi = 2 * pi * u.y;
    return {sine * std::cos(phi), sine * std::sin(phi), glm::max(cosine, 1e-9f)};
  }
  float pdf_multiple(float cosine) const {
    const float smallest = smallest_cosine();
    const float logarithmic = 1 / (2 * pi * (cosine + smallest) * std::log1p(1 / smallest));
    return glm::mix(logarithmic, pdf_cosine_hemisphere(cosine), roughness);
  }
  /// Shares of light that is reflected near the nodes of FacetAngles.
  FacetAngles::Nodes directional_nodes(Vec3 w) const {
    return anisotropic_ggx ? anisotropic_ggx->directional_nodes(alpha, w) : angles->directional(roughness, w.z);
  }
  FacetAngles::Nodes average_nodes() const {
    return anisotropic_ggx ? anisotropic_ggx->average_nodes(alpha) : angles->average(roughness);
  }
  /// What dielectric_directional() lacks by the film.
  FilmedDielectricAlbedo::Nodes film_directional(Vec3 w, bool from_inside) const {
    return anisotropic_dielectric ? anisotropic_dielectric->directional_nodes(alpha, w, from_inside)
                                  : filmed_dielectric->directional(roughness, glm::abs(w.z), from_inside);
  }
  FilmedDielectricAlbedo::Nodes film_average(bool from_inside) const {
    return anisotropic_dielectric ? anisotropic_dielectric->average_nodes(alpha, from_inside)
                                  : filmed_dielectric->average(roughness, from_inside);
  }

 private:
  /// Facets lose about the same for all that are smaller.
  float smallest_cosine() const { return glm::max(sqr(roughness), ggx_min_alpha); }
  /// That of isotropic facets as seen from w.
  float projected_roughness(Vec3 w) const {
    const float sin2 = sqr(w.x) + sqr(w.y);
    return sin2 > 0 ? glm::pow((sqr(alpha.x * w.x) + sqr(alpha.y * w.y)) / sin2, 0.25f) : roughness;
  }
};

}  // namespace candil
