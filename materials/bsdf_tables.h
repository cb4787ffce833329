/// Albedos that closures need to keep energy, tabulated once per scene.
#pragma once

#include <optional>
#include <vector>

#include "core/scene.h"
#include "materials/ggx_albedo.h"
#include "materials/sheen_albedo.h"

namespace candil {

/// Built from a scene beside it; read by make_bsdf(). Tables of rough dielectrics exist only for the indices of
/// refraction that the scene uses.
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
  /// fresnel_conductor_average() of a material that is a conductor.
  Vec3 mean_fresnel(std::uint32_t material) const { return mean_fresnel_of_material_[material]; }

 private:
  GgxAlbedo ggx_;
  std::optional<SheenAlbedo> sheen_;
  std::vector<DielectricAlbedo> dielectrics_;
  std::vector<std::uint32_t> dielectric_of_material_;
  std::vector<Vec3> mean_fresnel_of_material_;
};

}  // namespace candil
