#include "materials/bsdf_tables.h"

#include <algorithm>

#include "core/wavelength.h"
#include "materials/fresnel.h"

namespace candil {

namespace {

/// The place of the table for that index of refraction, which is made if there is none.
template <typename Table, typename... More>
std::uint32_t table_of(std::vector<Table>& tables, float ior, const More&... more) {
  const auto known = std::find_if(tables.begin(), tables.end(), [&](const Table& table) { return table.ior() == ior; });
  const auto place = static_cast<std::uint32_t>(known - tables.begin());
  if (known == tables.end()) tables.emplace_back(ior, more...);
  return place;
}

bool refracts(const Material& material) {
  return material.transmission > 0 && material.is_volume() && material.ior != 0 && !is_index_matched(material.ior);
}

/// KHR_materials_specular, where it changes what facets keep.
bool reshapes_reflectance(const Material& material) {
  return refracts(material) && (material.specular != 1 || material.specular_texture.is_used() ||
                                material.specular_color != Vec3(1) || material.specular_color_texture.is_used());
}

/// The same for all indices of refraction that a material shows.
std::uint32_t graded_table_of(std::vector<GradedDielectricAlbedo>& tables, const Material& material) {
  const float ior = material.ior;
  DielectricRange range{ior, ior, ior, material.extensions && material.extensions->clearcoat > 0,
                        reshapes_reflectance(material)};
  if (material.is_dispersive()) {
    range.least_ior = dispersed_ior(ior, material.extensions->dispersion, longest_wavelength);
    range.greatest_ior = dispersed_ior(ior, material.extensions->dispersion, shortest_wavelength);
  }
  const auto known = std::find_if(tables.begin(), tables.end(),
                                  [&](const GradedDielectricAlbedo& table) { return table.range() == range; });
  const auto place = static_cast<std::uint32_t>(known - tables.begin());
  if (known == tables.end()) tables.emplace_back(range);
  return place;
}

bool is_used(const Material& material, float MaterialExtensions::*extension) {
  return material.extensions && (*material.extensions).*extension > 0;
}

}  // namespace

bool has_extended_facets(const Material& material) {
  if (material.model != MaterialModel::metallic_roughness) return false;
  if (material.roughness > 0 && reshapes_reflectance(material)) return true;
  if (!material.extensions) return false;
  const MaterialExtensions& more = *material.extensions;
  return more.clearcoat > 0 || !is_black(more.sheen_color) || more.anisotropy > 0 || more.iridescence > 0 ||
         more.diffuse_transmission > 0 || material.is_dispersive() || material.scatters();
}

BsdfTables::BsdfTables(const Scene& scene)
    : dielectric_of_material_(scene.materials.size(), invalid_id),
      graded_dielectric_of_material_(scene.materials.size(), invalid_id),
      anisotropic_dielectric_of_material_(scene.materials.size(), invalid_id),
      filmed_dielectric_of_material_(scene.materials.size(), invalid_id),
      mean_fresnel_of_material_(scene.materials.size()) {
  const bool has_films = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
    return is_used(material, &MaterialExtensions::iridescence);
  });
  const bool may_be_reshaped = std::any_of(scene.materials.begin(), scene.materials.end(), reshapes_reflectance);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    if (material.model == MaterialModel::conductor) {
      mean_fresnel_of_material_[m] = fresnel_conductor_average(material.conductor_eta, material.conductor_k);
    }
    if (material.model != MaterialModel::metallic_roughness) continue;
    if (!sheen_ && material.extensions && !is_black(material.extensions->sheen_color)) sheen_.emplace();
    const bool is_extended = has_extended_facets(material);
    if (is_extended) graded_ggx_ = &GradedGgxAlbedo::shared();
    const bool is_anisotropic = is_used(material, &MaterialExtensions::anisotropy);
    const bool is_iridescent = is_used(material, &MaterialExtensions::iridescence);
    if (is_anisotropic) anisotropic_ggx_ = &AnisotropicAlbedo::shared(has_films);
    if (is_iridescent && !iridescence_) iridescence_ = std::make_unique<Iridescence>();
    if (!refracts(material)) continue;
    if (is_extended && (material.roughness > 0 || is_anisotropic)) {
      graded_dielectric_of_material_[m] = graded_table_of(graded_dielectrics_, material);
    } else if (material.roughness > 0) {
      dielectric_of_material_[m] = table_of(dielectrics_, material.ior);
    }
    if (is_anisotropic) {
      anisotropic_dielectric_of_material_[m] =
          table_of(anisotropic_dielectrics_, material.ior, has_films, may_be_reshaped, *anisotropic_ggx_);
    }
    // Also of an anisotropic material: a texture may take the anisotropy away.
    if (is_iridescent && material.roughness > 0) {
      filmed_dielectric_of_material_[m] = table_of(filmed_dielectrics_, material.ior);
    }
  }
}

}  // namespace candil
