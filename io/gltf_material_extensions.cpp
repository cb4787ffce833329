// One function for each extension, in the order of the layers that they describe, innermost first.
#include "io/gltf_material_source.h"

namespace candil {

namespace {

void read_specular_glossiness(const GltfProperties& properties, Material& material) {
  material.model = MaterialModel::specular_glossiness;
  material.base_color = Vec4(1);
  material.base_color_texture = {};
  properties.read("diffuseFactor", 0, 1, material.base_color);
  properties.read("diffuseTexture", material.base_color_texture);
  properties.read("specularFactor", 0, 1, material.specular_color);
  properties.read("specularGlossinessTexture", material.specular_color_texture);
  float glossiness = 1;
  properties.read("glossinessFactor", 0, 1, glossiness);
  material.roughness = 1 - glossiness;
  material.metallic_roughness_texture = {};
}

void read_ior(const GltfProperties& properties, Material& material) {
  // Zero stands for an infinite index, everything else below 1 is out of range.
  properties.read("ior", 0, any_positive, material.ior);
  if (material.ior > 0 && material.ior < 1) properties.read("ior", 1, any_positive, material.ior);
}

void read_specular(const GltfProperties& properties, Material& material) {
  properties.read("specularFactor", 0, 1, material.specular);
  properties.read("specularTexture", material.specular_texture);
  properties.read("specularColorFactor", 0, any_positive, material.specular_color);
  properties.read("specularColorTexture", material.specular_color_texture);
}

void read_transmission(const GltfProperties& properties, Material& material) {
  properties.read("transmissionFactor", 0, 1, material.transmission);
  properties.read("transmissionTexture", material.transmission_texture);
}

void read_volume(const GltfProperties& properties, Material& material) {
  properties.read("thicknessFactor", 0, any_positive, material.thickness);
  properties.read("attenuationColor", 0, 1, material.attenuation_color);
  properties.read("attenuationDistance", 0, any_positive, material.attenuation_distance);
  if (material.attenuation_distance == 0) {
    properties.warn("attenuationDistance", "must be above 0, none is used");
    material.attenuation_distance = infinity;
  }
}

// The extensions below leave everything alone where they have no effect, and so cost neither textures nor time.

void read_dispersion(const GltfProperties& properties, MaterialExtensions& more) {
  properties.read("dispersion", 0, any_measure, more.dispersion);
}

void read_diffuse_transmission(const GltfProperties& properties, MaterialExtensions& more) {
  properties.read("diffuseTransmissionFactor", 0, 1, more.diffuse_transmission);
  if (more.diffuse_transmission == 0) return;
  properties.read("diffuseTransmissionTexture", more.diffuse_transmission_texture);
  properties.read("diffuseTransmissionColorFactor", 0, 1, more.diffuse_transmission_color);
  properties.read("diffuseTransmissionColorTexture", more.diffuse_transmission_color_texture);
}

/// Files of its first draft say multiscatterColor.
void read_volume_scatter(const GltfProperties& properties, MaterialExtensions& more) {
  constexpr double below_one = 0.9999;
  const char* const color = properties.has("multiscatterColorFactor") ? "multiscatterColorFactor" : "multiscatterColor";
  properties.read(color, 0, below_one, more.multiscatter_color);
  if (is_black(more.multiscatter_color)) return;
  properties.read("scatterAnisotropy", -below_one, below_one, more.scatter_anisotropy);
}

void read_anisotropy(const GltfProperties& properties, MaterialExtensions& more) {
  properties.read("anisotropyStrength", 0, 1, more.anisotropy);
  if (more.anisotropy == 0) return;
  properties.read("anisotropyRotation", -any_measure, any_measure, more.anisotropy_rotation);
  properties.read("anisotropyTexture", more.anisotropy_texture);
}

void read_iridescence(const GltfProperties& properties, MaterialExtensions& more) {
  properties.read("iridescenceFactor", 0, 1, more.iridescence);
  if (more.iridescence == 0) return;
  properties.read("iridescenceTexture", more.iridescence_texture);
  properties.read("iridescenceIor", 1, any_measure, more.iridescence_ior);
  properties.read("iridescenceThicknessMinimum", 0, any_measure, more.iridescence_thickness_low);
  properties.read("iridescenceThicknessMaximum", 0, any_measure, more.iridescence_thickness);
  properties.read("iridescenceThicknessTexture", more.iridescence_thickness_texture);
}

void read_sheen(const GltfProperties& properties, MaterialExtensions& more) {
  properties.read("sheenColorFactor", 0, 1, more.sheen_color);
  if (is_black(more.sheen_color)) return;
  properties.read("sheenColorTexture", more.sheen_color_texture);
  properties.read("sheenRoughnessFactor", 0, 1, more.sheen_roughness);
  properties.read("sheenRoughnessTexture", more.sheen_roughness_texture);
}

void read_clearcoat(const GltfProperties& properties, MaterialExtensions& more) {
  properties.read("clearcoatFactor", 0, 1, more.clearcoat);
  if (more.clearcoat == 0) return;
  properties.read("clearcoatTexture", more.clearcoat_texture);
  properties.read("clearcoatRoughnessFactor", 0, 1, more.clearcoat_roughness);
  properties.read("clearcoatRoughnessTexture", more.clearcoat_roughness_texture);
  properties.read("clearcoatNormalTexture", more.clearcoat_normal_texture, more.clearcoat_normal_scale);
}

/// One line for what a material says in vain: by their own texts these extensions go neither with
/// KHR_materials_pbrSpecularGlossiness nor with KHR_materials_unlit.
void warn_of_excluded(const MaterialSource& source, const char* by) {
  constexpr const char* metallic_roughness_only[] = {
      "KHR_materials_anisotropy", "KHR_materials_clearcoat",     "KHR_materials_diffuse_transmission",
      "KHR_materials_dispersion", "KHR_materials_ior",           "KHR_materials_iridescence",
      "KHR_materials_sheen",      "KHR_materials_specular",      "KHR_materials_transmission",
      "KHR_materials_volume",     "KHR_materials_volume_scatter"};
  std::string names;
  int count = 0;
  for (const char* name : metallic_roughness_only) {
    if (source.has_extension(name)) names += (count++ == 0 ? "" : ", ") + std::string(name);
  }
  if (count == 0) return;
  source.warnings.add(source.place + ".extensions",
                      names + (count == 1 ? " does" : " do") + " not go with " + by + ", which alone is used");
}

/// Whether a surface looks other with the extensions than without.
bool has_effect(const MaterialExtensions& more) {
  return more.clearcoat > 0 || !is_black(more.sheen_color) || more.anisotropy > 0 || more.iridescence > 0 ||
         more.dispersion > 0 || more.diffuse_transmission > 0 || !is_black(more.multiscatter_color);
}

}  // namespace

void read_material_extensions(const MaterialSource& source, Material& material) {
  material.is_unlit = source.has_extension("KHR_materials_unlit");
  if (material.is_unlit) {
    warn_of_excluded(source, "KHR_materials_unlit");
    return;  // base colour, alpha and sides are all of it
  }
  if (const auto properties = source.extension("KHR_materials_pbrSpecularGlossiness")) {
    read_specular_glossiness(*properties, material);
    warn_of_excluded(source, "KHR_materials_pbrSpecularGlossiness");
    return;
  }
  const auto visit = [&](const char* name, const auto& read, auto& target) {
    if (const auto properties = source.extension(name)) read(*properties, target);
  };
  visit("KHR_materials_ior", read_ior, material);
  visit("KHR_materials_specular", read_specular, material);
  visit("KHR_materials_transmission", read_transmission, material);
  visit("KHR_materials_volume", read_volume, material);
  MaterialExtensions more;
  if (material.is_volume()) visit("KHR_materials_dispersion", read_dispersion, more);
  visit("KHR_materials_diffuse_transmission", read_diffuse_transmission, more);
  visit("KHR_materials_volume_scatter", read_volume_scatter, more);
  visit("KHR_materials_anisotropy", read_anisotropy, more);
  visit("KHR_materials_iridescence", read_iridescence, more);
  visit("KHR_materials_sheen", read_sheen, more);
  visit("KHR_materials_clearcoat", read_clearcoat, more);
  if (has_effect(more)) material.extensions = more;
}

}  // namespace candil
