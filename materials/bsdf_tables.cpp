#include "materials/bsdf_tables.h"

#include <algorithm>

#include "materials/fresnel.h"

namespace candil {

BsdfTables::BsdfTables(const Scene& scene)
    : dielectric_of_material_(scene.materials.size(), invalid_id), mean_fresnel_of_material_(scene.materials.size()) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (material.model == MaterialModel::conductor) {
      mean_fresnel_of_material_[m] = fresnel_conductor_average(material.conductor_eta, material.conductor_k);
    }
    if (material.model != MaterialModel::metallic_roughness) continue;
    if (!sheen_ && material.extensions && !is_black(material.extensions->sheen_color)) sheen_.emplace();
    const bool refracts =
        material.transmission > 0 && material.is_volume() && material.ior != 0 && !is_index_matched(material.ior);
    if (!refracts || material.roughness == 0) continue;
    const auto known = std::find_if(dielectrics_.begin(), dielectrics_.end(),
                                    [&](const DielectricAlbedo& table) { return table.ior() == material.ior; });
    dielectric_of_material_[m] = static_cast<std::uint32_t>(known - dielectrics_.begin());
    if (known == dielectrics_.end()) dielectrics_.emplace_back(material.ior);
  }
}

}  // namespace candil
