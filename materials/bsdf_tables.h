/// Albedos that closures need to keep energy, tabulated once per scene.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "materials/anisotropy.h"
#include "materials/ggx_albedo.h"
#include "materials/sheen_albedo.h"
#include "materials/thin_film.h"

namespace candil {

/// Built from a scene beside it; read by make_bsdf(). Tables of rough dielectrics exist only for the indices of
/// refraction that the scene uses, those of extensions only if a material uses them.
class BsdfTables {
 public:
  explicit BsdfTables(const Scene& scene);

  const GgxAlbedo& ggx() const { return ggx_; }
  /// Null for a material that is not a rough refracting dielectric.
  const DielectricAlbedo* dielectric(std::uint32_t material) const {
    const std::uint32_t table = dielectric_of_material_[material];
    return table == invalid_id ? nullptr : &dielectrics_[table];
  }
  /// Only if a material of the scene has sheen.
  const SheenAlbedo& sheen() const { return *sheen_; }
  /// The same for a material that is anisotropic too.
  const AnisotropicDielectricAlbedo* anisotropic_dielectric(std::uint32_t material) const {
    const std::uint32_t table = anisotropic_dielectric_of_material_[material];
    return table == invalid_id ? nullptr : &anisotropic_dielectrics_[table];
  }
  /// Not null if a material is anisotropic.
  const AnisotropicAlbedo* anisotropic_ggx() const { return anisotropic_ggx_.get(); }
  /// What only iridescent materials need; not null if there is one.
  struct Iridescence {
    FilmSensitivity sensitivity;
    FacetAngles angles;
  };
  const Iridescence* iridescence() const { return iridescence_.get(); }
  /// fresnel_conductor_average() of a material that is a conductor.
  Vec3 mean_fresnel(std::uint32_t material) const { return mean_fresnel_of_material_[material]; }

 private:
  GgxAlbedo ggx_;
  std::optional<SheenAlbedo> sheen_;
  std::vector<DielectricAlbedo> dielectrics_;
  std::vector<std::uint32_t> dielectric_of_material_;
  std::unique_ptr<AnisotropicAlbedo> anisotropic_ggx_;
  std::vector<AnisotropicDielectricAlbedo> anisotropic_dielectrics_;
  std::vector<std::uint32_t> anisotropic_dielectric_of_material_;
  std::unique_ptr<Iridescence> iridescence_;
  std::vector<Vec3> mean_fresnel_of_material_;
};

}  // namespace candil
