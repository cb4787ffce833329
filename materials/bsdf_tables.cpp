#include "materials/bsdf_tables.h"

#include <algorithm>

#include "materials/fresnel.h"

namespace candil {

namespace {

/// The place of the table for that index of refraction, which is made if there is none.
template <typename Table>
std::uint32_t table_of(std::vector<Table>& tables, float ior) {
  const auto known = std::find_if(tables.begin(), tables.end(), [&](const Table& table) { return table.ior() == ior; });
  const auto place = static_cast<std::uint32_t>(known - tables.begin());
  if (known == tables.end()) tables.emplace_back(ior);
  return place;
}

}  // namespace

BsdfTables::BsdfTables(const Scene& scene)
    : dielectric_of_material_(scene.materials.size(), invalid_id),
      anisotropic_dielectric_of_material_(scene.materials.size(), invalid_id),
      mean_fresnel_of_material_(scene.materials.size()) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (material.model == MaterialModel::conductor) {
      mean_fresnel_of_material_[m] = fresnel_conductor_average(material.conductor_eta, material.conductor_k);
    }
    if (material.model != MaterialModel::metallic_roughness) continue;
    if (!sheen_ && material.extensions && !is_black(material.extensions->sheen_color)) sheen_.emplace();
    const bool is_anisotropic = material.extensions && material.extensions->anisotropy > 0;
    if (is_anisotropic && !anisotropic_ggx_) anisotropic_ggx_ = std::make_unique<AnisotropicAlbedo>();
    if (material.extensions && material.extensions->iridescence > 0 && !iridescence_) {
      iridescence_ = std::make_unique<Iridescence>();
    }
    const bool refracts =
        material.transmission > 0 && material.is_volume() && material.ior != 0 && !is_index_matched(material.ior);
    if (!refracts) continue;
    if (material.roughness > 0) dielectric_of_material_[m] = table_of(dielectrics_, material.ior);
    if (is_anisotropic) anisotropic_dielectric_of_material_[m] = table_of(anisotropic_dielectrics_, material.ior);
  }
}

}  // namespace candil
