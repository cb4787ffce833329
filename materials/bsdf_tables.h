/// Albedos that closures need to keep energy, tabulated once per scene.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "materials/anisotropy.h"
#include "materials/ggx_albedo.h"
#include "materials/graded_albedo.h"
#include "materials/sheen_albedo.h"
#include "materials/thin_film.h"

namespace candil {

/// Whether the material has extensions by which facets become ExtendedFacets: films and anisotropy, rough glass with
/// KHR_materials_specular, and all that has to know exactly what facets return or leave over.
bool has_extended_facets(const Material& material);

/// Built from a scene beside it; read by make_bsdf(). Tables of rough dielectrics exist only for the indices of
/// refraction that the scene uses, those of extensions only if a material uses them.
class BsdfTables {
 public:
  explicit BsdfTables(const Scene& scene);

  const GgxAlbedo& ggx() const { return ggx_; }
  /// Null for a material that is not a rough refracting dielectric, or has extended facets.
  const DielectricAlbedo* dielectric(std::uint32_t material) const {
    const std::uint32_t table = dielectric_of_material_[material];
    return table == invalid_id ? nullptr : &dielectrics_[table];
  }
  /// Not null if a material has extended facets.
  const GradedGgxAlbedo* graded_ggx() const { return graded_ggx_; }
  /// Not null for a rough refracting dielectric that has extended facets.
  const GradedDielectricAlbedo* graded_dielectric(std::uint32_t material) const {
    const std::uint32_t table = graded_dielectric_of_material_[material];
    return table == invalid_id ? nullptr : &graded_dielectrics_[table];
  }
  /// Only if a material of the scene has sheen.
  const SheenAlbedo& sheen() const { return *sheen_; }
  /// dielectric() of a material that is anisotropic.
  const AnisotropicDielectricAlbedo* anisotropic_dielectric(std::uint32_t material) const {
    const std::uint32_t table = anisotropic_dielectric_of_material_[material];
    return table == invalid_id ? nullptr : &anisotropic_dielectrics_[table];
  }
  /// What to add to it for a material that is iridescent.
  const FilmedDielectricAlbedo* filmed_dielectric(std::uint32_t material) const {
    const std::uint32_t table = filmed_dielectric_of_material_[material];
    return table == invalid_id ? nullptr : &filmed_dielectrics_[table];
  }
  /// Not null if a material is anisotropic.
  const AnisotropicAlbedo* anisotropic_ggx() const { return anisotropic_ggx_; }
  /// What only iridescent materials need; not null if there is one.
  struct Iridescence {
    FilmSensitivity sensitivity;
    FacetAngles angles;
  };
  const Iridescence* iridescence() const { return iridescence_.get(); }
  /// fresnel_conductor_average() of a material that is a conductor.
  Vec3 mean_fresnel(std::uint32_t material) const { return mean_fresnel_of_material_[material]; }

 private:
  const GgxAlbedo& ggx_ = GgxAlbedo::shared();
  std::optional<SheenAlbedo> sheen_;
  std::vector<DielectricAlbedo> dielectrics_;
  std::vector<std::uint32_t> dielectric_of_material_;
  const GradedGgxAlbedo* graded_ggx_ = nullptr;
  std::vector<GradedDielectricAlbedo> graded_dielectrics_;
  std::vector<std::uint32_t> graded_dielectric_of_material_;
  const AnisotropicAlbedo* anisotropic_ggx_ = nullptr;
  std::vector<AnisotropicDielectricAlbedo> anisotropic_dielectrics_;
  std::vector<std::uint32_t> anisotropic_dielectric_of_material_;
  std::vector<FilmedDielectricAlbedo> filmed_dielectrics_;
  std::vector<std::uint32_t> filmed_dielectric_of_material_;
  std::unique_ptr<Iridescence> iridescence_;
  std::vector<Vec3> mean_fresnel_of_material_;
};

}  // namespace candil
