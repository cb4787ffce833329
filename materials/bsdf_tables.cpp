#include "materials/bsdf_tables.h"

#include <algorithm>

namespace candil {

BsdfTables::BsdfTables(const Scene& scene) : dielectric_of_material_(scene.materials.size(), invalid_id) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const bool refracts = material.is_volume() && material.ior != 0 && material.ior != 1;
    if (!refracts || material.roughness == 0) continue;
    const auto known = std::find_if(dielectrics_.begin(), dielectrics_.end(),
                                    [&](const DielectricAlbedo& table) { return table.ior() == material.ior; });
    dielectric_of_material_[m] = static_cast<std::uint32_t>(known - dielectrics_.begin());
    if (known == dielectrics_.end()) dielectrics_.emplace_back(material.ior);
  }
}

}  // namespace candil
