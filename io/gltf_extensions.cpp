#include "io/gltf_extensions.h"

#include <algorithm>
#include <array>

#include "io/error.h"
#include "io/resource.h"

namespace candil {

namespace {

constexpr std::array<std::string_view, 13> supported = {
    "EXT_texture_webp",    "KHR_lights_punctual",    "KHR_materials_emissive_strength",
    "KHR_materials_ior",   "KHR_materials_specular", "KHR_materials_transmission",
    "KHR_materials_unlit", "KHR_materials_volume",   "KHR_mesh_quantization",
    "KHR_node_visibility", "KHR_texture_transform",  "KHR_texture_basisu",
    "EXT_texture_avif",
};

constexpr std::array<std::string_view, 5> harmless = {
    "KHR_materials_variants", "KHR_node_hoverability", "KHR_node_selectability", "KHR_xmp", "KHR_xmp_json_ld",
};

template <std::size_t count>
bool contains(const std::array<std::string_view, count>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

bool is_supported_gltf_extension(std::string_view extension) { return contains(supported, extension); }

bool is_harmless_gltf_extension(std::string_view extension) { return contains(harmless, extension); }

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
