/// Glass and thin sheets: the transmitting part of the glTF material (KHR_materials_transmission, _volume, _ior,
/// _specular).
///
/// A volume refracts with exact Fresnel reflectance at GGX facets (Walter et al. 2007). A thin-walled surface does not
/// bend light: its transmission is the reflection lobe mirrored through the sheet, as the extension's text has it.
/// KHR_materials_specular reshapes the reflectance between its f0 and f90; without it the exact curve stands. Energy
/// lost between facets comes back as diffuse-like lobes on both sides, split so that the closure stays reciprocal
/// (Kulla and Conty 2017, dielectrics); its tables are those of the exact curve, for each wavelength and with a coat
/// beyond it, of what KHR_materials_specular changes (ReshapedDielectric: extended facets only, and all materials with
/// it have these), and of what a thin film changes (FilmedDielectricAlbedo). Seen from inside, a clear coat lies beyond
/// the interface, and each facet gets Fresnel's reflectance of both, as if the coat were smooth and parallel to the
/// facet: what a coat does not let in by one way it does not let out by the same. Local frame: z is the shading normal,
/// wo.z > 0; wi.z < 0 is transmission.
#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "materials/bsdf_sample.h"
#include "materials/facets.h"

namespace candil {

struct DielectricParameters {
  float roughness = 0;          ///< Perceptual; extended facets bring theirs.
  float ior = 1.5f;             ///< Of the medium behind the front side; 0: infinite.
  float reflecting_ior = 1.5f;  ///< The same, of which reflectance follows; another one only where light is dispersed.
  bool is_thin = false;
  bool from_inside = false;   ///< wo is inside of the medium; false for thin walls.
  Vec3 tint{1.0f};            ///< Colour of what is transmitted at this interface.
  Vec3 f0{0.04f}, f90{1.0f};  ///< Reflectance at normal and grazing incidence.
  float coat_beyond = 0;      ///< Weight of a clear coat that lies on the other side; 0 for thin walls.
  /// Of this index; may be null when the surface is smooth or does not refract. Extended facets bring theirs.
  const DielectricAlbedo* table = nullptr;
};

template <typename Facets>
class BasicDielectricLobes {
 public:
  /// `facets` have the table of this index, unless they are smooth or nothing is refracted.
  BasicDielectricLobes(const DielectricParameters& parameters, const Facets& facets, Vec3 wo);
  BasicDielectricLobes(const DielectricParameters& parameters, const GgxAlbedo& ggx,
                       Vec3 wo) requires(!Facets::is_extended)
      : BasicDielectricLobes(parameters, Facets(parameters.roughness, ggx, parameters.table), wo) {}

  BsdfEval eval(Vec3 wo, Vec3 wi) const;
  std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u_direction) const;
  bool is_purely_delta() const { return is_delta_; }
  Vec3 albedo() const { return glm::mix(tint_, Vec3(1), 0.04f); }

 private:
  enum class Side { here, beyond };
  /// That is lost between facets: under a film it has colours.
  using Energy = std::conditional_t<Facets::is_extended, Vec3, float>;

  /// Of a facet, with what a coat beyond it sends back.
  Vec3 reflectance(float cosine) const;
  Vec3 reflectance_without_coat(float cosine) const;
  Vec3 reflectance_without_film(float cosine) const;
  Vec3 film_reflectance(float cosine) const;
  bool refracts() const { return !is_thin_ && !reflects_all_ && facets_.has_dielectric_table(); }
  /// Over the cosine-weighted hemisphere; of a thin wall.
  Vec3 mean_reflectance() const;
  /// Probability of following the reflected ray at a facet, given its reflectance.
  float reflection_probability(Vec3 facet_reflectance) const;
  Vec3 more_lost(Side side, const ReshapedDielectric& reshaped, float by_coat) const;
  Energy lost_energy(Vec3 w, Side side) const;
  Energy mean_lost_energy(Side side) const;
  void reshape();
  void add_film();
  BsdfEval eval_facets(Vec3 wo, Vec3 wi) const;
  BsdfEval eval_multiple(Vec3 wi) const;
  std::optional<BsdfSample> sample_delta(Vec3 wo, float u_lobe) const;

  Facets facets_;
  float eta_ = 1;             // index beyond the interface over the index on wo's side
  float reflecting_eta_ = 1;  // the same, of which reflectance follows
  bool is_thin_ = false, from_inside_ = false, is_delta_ = true;
  bool has_exact_fresnel_ = true, reflects_all_ = false;
  Vec3 tint_{1.0f}, f0_{0.04f}, f90_{1.0f};
  float coat_beyond_ = 0;
  Energy lost_{0.0f};  // energy towards wo that single scattering loses
  Energy mean_lost_here_{1.0f}, mean_lost_beyond_{1.0f};
  Energy multiple_transmitted_{0.0f};                                 // share of the lost energy that goes beyond
  float broad_probability_ = 0, broad_transmission_probability_ = 0;  // of its lobes; beyond given that
  // What the tables do not know of a reflectance that is not Fresnel's F: constant + factor F, and the film.
  bool is_reshaped_ = false;
  Energy reshaped_constant_{0.0f}, reshaped_factor_{1.0f};
  struct NoFilm {};
  using FilmNodes =
      std::conditional_t<Facets::is_extended, std::array<Vec3, FilmedDielectricAlbedo::node_count>, NoFilm>;
  [[no_unique_address]] FilmNodes film_nodes_{};  // what it adds to the reflectance; nothing without one
};

using DielectricLobes = BasicDielectricLobes<PlainFacets>;
using ExtendedDielectricLobes = BasicDielectricLobes<ExtendedFacets>;

}  // namespace candil
