#include "io/gltf_extensions.h"

#include <algorithm>
#include <array>

#include "io/error.h"
#include "io/resource.h"

namespace candil {

namespace {

constexpr std::array table = std::to_array<GltfExtension>({
    {"EXT_lights_ies", GltfTier::unsupported},
    {"EXT_lights_image_based", GltfTier::unsupported},
    {"EXT_mesh_gpu_instancing", GltfTier::unsupported},
    {"EXT_meshopt_compression", GltfTier::unsupported},
    {"EXT_texture_avif", GltfTier::full},
    {"EXT_texture_webp", GltfTier::full},
    {"KHR_animation_pointer", GltfTier::unsupported},
    {"KHR_draco_mesh_compression", GltfTier::unsupported},
    {"KHR_lights_punctual", GltfTier::full},
    {"KHR_materials_anisotropy", GltfTier::unsupported},
    {"KHR_materials_clearcoat", GltfTier::unsupported},
    {"KHR_materials_diffuse_transmission", GltfTier::unsupported},
    {"KHR_materials_dispersion", GltfTier::unsupported},
    {"KHR_materials_emissive_strength", GltfTier::full},
    {"KHR_materials_ior", GltfTier::full},
    {"KHR_materials_iridescence", GltfTier::unsupported},
    {"KHR_materials_pbrSpecularGlossiness", GltfTier::full},
    {"KHR_materials_sheen", GltfTier::unsupported},
    {"KHR_materials_specular", GltfTier::full},
    {"KHR_materials_transmission", GltfTier::full},
    {"KHR_materials_unlit", GltfTier::full},
    {"KHR_materials_variants", GltfTier::harmless},
    {"KHR_materials_volume", GltfTier::full},
    {"KHR_materials_volume_scatter", GltfTier::unsupported},
    {"KHR_mesh_quantization", GltfTier::full},
    {"KHR_meshopt_compression", GltfTier::unsupported},
    {"KHR_node_hoverability", GltfTier::harmless},
    {"KHR_node_selectability", GltfTier::harmless},
    {"KHR_node_visibility", GltfTier::full},
    {"KHR_texture_basisu", GltfTier::full},
    {"KHR_texture_transform", GltfTier::full},
    {"KHR_xmp", GltfTier::harmless},
    {"KHR_xmp_json_ld", GltfTier::harmless},
});

const GltfExtension* find_extension(std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.name == name; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace

std::span<const GltfExtension> gltf_extensions() { return table; }

bool is_supported_gltf_extension(std::string_view extension) {
  const GltfExtension* const known = find_extension(extension);
  return known != nullptr && known->is_honoured();
}

bool is_harmless_gltf_extension(std::string_view extension) {
  const GltfExtension* const known = find_extension(extension);
  return known != nullptr && known->tier == GltfTier::harmless;
}

void refuse_unknown_gltf_extensions(const std::vector<std::string>& required, const std::string& name) {
  std::string missing;
  int count = 0;
  for (const std::string& extension : required) {
    if (is_supported_gltf_extension(extension) || is_harmless_gltf_extension(extension)) continue;
    missing += (count++ == 0 ? "" : ", ") + printable(extension);
  }
  if (count == 0) return;
  throw InputError(name, "extensionsRequired",
                   missing + (count == 1 ? " is" : " are") + " not supported; export the file without " +
                       (count == 1 ? "it" : "them"));
}

}  // namespace candil
