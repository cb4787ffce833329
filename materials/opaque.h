/// Metal and coated diffuse: the opaque part of the glTF material, as one GGX specular lobe over a diffuse base.
/// (KHR_materials_pbrSpecularGlossiness is such a coat too.)
///
/// glTF 2.0, appendix B: mix(fresnel_mix(diffuse, specular), conductor, metallic). Schlick's term is linear in f0 and
/// f90, so metal and dielectric share one specular lobe. What the text leaves to the renderer:
/// - energy lost between facets comes back as a diffuse-like lobe (Kulla and Conty 2017), coloured by repeated Fresnel
/// reflection;
/// - the base gets what the coat's albedo leaves over, on the way in and out (Kelemen and Szirmay-Kalos 2001), instead
///   of 1 - F(V.H): white stays exactly white in a furnace, and the lobe is reciprocal.
/// KHR_materials_diffuse_transmission lets a share of the base's light through to the other side. The coat is on both
/// sides of the sheet: what crosses the base has crossed the one and the other, alike.
/// Local frame: z is the shading normal, wo.z > 0; wi.z < 0 is diffuse transmission.
#pragma once

#include <optional>
#include <type_traits>

#include "materials/bsdf_sample.h"
#include "materials/facets.h"
#include "materials/opaque_film.h"
#include "materials/shadow_terminator.h"

namespace candil {

struct OpaqueParameters {
  float roughness = 1;                 ///< Perceptual; extended facets bring theirs.
  float metallic = 0;                  ///< Share of the metal.
  Vec3 base{0.0f};                     ///< Albedo of the diffuse base, f0 of the metal.
  Vec3 coat_f0{0.0f}, coat_f90{0.0f};  ///< Reflectance of the dielectric coat at normal and grazing incidence.
  float diffuse_transmission = 0;      ///< Share of the diffuse base that lets light through instead of reflecting it.
  Vec3 transmission_color{1.0f};       ///< Of that share, in place of `base`.
};

template <typename Facets>
class BasicOpaqueLobes {
 public:
  BasicOpaqueLobes(const OpaqueParameters& parameters, const Facets& facets, Vec3 wo);
  BasicOpaqueLobes(const OpaqueParameters& parameters, const GgxAlbedo& table, Vec3 wo) requires(!Facets::is_extended)
      : BasicOpaqueLobes(parameters, Facets(parameters.roughness, table), wo) {}

  BsdfEval eval(Vec3 wo, Vec3 wi, const ShadowTerminator& terminator) const;
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u_direction, const ShadowTerminator& terminator) const;
  bool is_purely_delta() const { return (is_delta_ || !has_specular_) && is_black(diffuse_) && is_black(transmitted_); }
  Vec3 albedo() const { return albedo_; }
  float survival_probability() const { return max_component(albedo_); }

 private:
  struct NoFilm {};

  GgxAlbedo::Split single_scattering(Vec3 w) const;
  /// Of the specular interface at a facet.
  Vec3 reflectance(float cosine) const;
  /// Albedo of the coat's first scattering, in its greatest channel.
  float coat_albedo(Vec3 w, const GgxAlbedo::Split& single) const;
  /// What the coat leaves over for the base, given its single scattering.
  float left_by_coat(Vec3 w, const GgxAlbedo::Split& single) const;
  Vec3 diffuse_like(Vec3 wi) const;
  BsdfEval eval_transmission(Vec3 wi, const ShadowTerminator& terminator) const;

  Facets facets_;
  bool has_specular_ = false, is_delta_ = false;
  float specular_probability_ = 0, transmission_probability_ = 0;
  float multiple_probability_ = 0;  // 0 if facets are plain: the cosine serves for that lobe too
  Vec3 f0_{0.0f}, f90_{0.0f};
  Vec3 diffuse_{0.0f};      // base albedo x (1 - coat albedo towards wo) / (1 - mean coat albedo)
  Vec3 transmitted_{0.0f};  // the same for the share that lets light through
  Vec3 multiple_{0.0f};     // colour x (1 - E(wo)) / (1 - mean E)
  float coat_f0_ = 0, coat_f90_ = 0, coat_multiple_ = 0;
  Vec3 albedo_{0.0f};
  // What the film adds to the curves from f0 to f90.
  using Film = std::conditional_t<Facets::is_extended, std::optional<OpaqueFilm>, NoFilm>;
  using CoatCurve = std::conditional_t<Facets::is_extended, FilmCurve<float>, NoFilm>;
  [[no_unique_address]] Film film_;
  [[no_unique_address]] CoatCurve film_coat_;
};

using OpaqueLobes = BasicOpaqueLobes<PlainFacets>;
using ExtendedOpaqueLobes = BasicOpaqueLobes<ExtendedFacets>;

}  // namespace candil
