#include "io/gltf_extensions.h"

#include <algorithm>
#include <array>

#include "io/error.h"
#include "io/resource.h"

namespace candil {

namespace {

// Packages that this build was made without.
#ifdef CANDIL_HAS_DRACO
constexpr std::string_view no_draco;
#else
constexpr std::string_view no_draco = "libdraco-dev";
#endif
#ifdef CANDIL_HAS_MESHOPTIMIZER
constexpr std::string_view no_meshopt;
#else
constexpr std::string_view no_meshopt = "libmeshoptimizer-dev";
#endif

#ifdef CANDIL_HAS_ZSTD
constexpr GltfTier basisu_tier = GltfTier::full;
constexpr std::string_view basisu_remark;
#else
constexpr GltfTier basisu_tier = GltfTier::partial;
constexpr std::string_view basisu_remark = "nothing under Zstandard: this build has no libzstd-dev";
#endif

constexpr std::array table = std::to_array<GltfExtension>({
    {"ADOBE_materials_clearcoat_specular", GltfTier::unsupported},
    {"ADOBE_materials_clearcoat_tint", GltfTier::unsupported},
    {"ADOBE_materials_thin_transparency", GltfTier::unsupported},
    {"AGI_stk_metadata", GltfTier::harmless, "metadata"},
    {"CESIUM_primitive_outline", GltfTier::unsupported},
    {"EXT_instance_features", GltfTier::harmless, "metadata"},
    {"EXT_lights_ies", GltfTier::unsupported},
    {"EXT_lights_image_based", GltfTier::full},
    {"EXT_mesh_features", GltfTier::harmless, "metadata"},
    {"EXT_mesh_gpu_instancing", GltfTier::full},
    {"EXT_mesh_manifold", GltfTier::harmless, "topology of the same triangles"},
    {"EXT_meshopt_compression", GltfTier::full, {}, no_meshopt},
    {"EXT_structural_metadata", GltfTier::harmless, "metadata"},
    {"EXT_texture_avif", GltfTier::full, {}, {}, ImageFormat::avif},
    {"EXT_texture_webp", GltfTier::full, {}, {}, ImageFormat::webp},
    {"FB_geometry_metadata", GltfTier::harmless, "metadata"},
    {"FB_ngon_encoding", GltfTier::harmless, "polygons of the same triangles"},
    {"GODOT_single_root", GltfTier::harmless, "structure"},
    {"GRIFFEL_bim_data", GltfTier::harmless, "metadata"},
    {"KHR_animation_pointer", GltfTier::full},
    {"KHR_draco_mesh_compression", GltfTier::full, {}, no_draco},
    {"KHR_gaussian_splatting", GltfTier::unsupported},
    {"KHR_interactivity", GltfTier::unsupported, "nothing is run"},
    {"KHR_lights_punctual", GltfTier::full},
    {"KHR_materials_anisotropy", GltfTier::full},
    {"KHR_materials_clearcoat", GltfTier::partial, "does not darken emission"},
    {"KHR_materials_diffuse_transmission", GltfTier::full},
    {"KHR_materials_dispersion", GltfTier::full},
    {"KHR_materials_emissive_strength", GltfTier::full},
    {"KHR_materials_ior", GltfTier::full},
    {"KHR_materials_iridescence", GltfTier::full},
    {"KHR_materials_pbrSpecularGlossiness", GltfTier::full},
    {"KHR_materials_sheen", GltfTier::full},
    {"KHR_materials_specular", GltfTier::full},
    {"KHR_materials_transmission", GltfTier::full},
    {"KHR_materials_unlit", GltfTier::full},
    {"KHR_materials_variants", GltfTier::full, "the materials of the primitives, or --variant"},
    {"KHR_materials_volume", GltfTier::full, "rays measure the thickness"},
    {"KHR_materials_volume_scatter", GltfTier::experimental, "--experimental volume-scatter has it"},
    {"KHR_mesh_quantization", GltfTier::full},
    {"KHR_meshopt_compression", GltfTier::partial,
     "version 1 of the vertex codec with meshoptimizer 0.23 or newer, the filter COLOR with 0.25", no_meshopt},
    {"KHR_node_hoverability", GltfTier::harmless, "interaction"},
    {"KHR_node_selectability", GltfTier::harmless, "interaction"},
    {"KHR_node_visibility", GltfTier::full},
    {"KHR_techniques_webgl", GltfTier::unsupported},
    {"KHR_texture_basisu", basisu_tier, basisu_remark},
    {"KHR_texture_transform", GltfTier::full},
    {"KHR_xmp", GltfTier::harmless, "metadata"},
    {"KHR_xmp_json_ld", GltfTier::harmless, "metadata"},
    {"MSFT_lod", GltfTier::harmless, "the finest level is shown"},
    {"MSFT_packing_normalRoughnessMetallic", GltfTier::unsupported, "the core textures are used"},
    {"MSFT_packing_occlusionRoughnessMetallic", GltfTier::unsupported, "the core textures are used"},
    {"MSFT_texture_dds", GltfTier::unsupported, "the core image is used"},
    {"NV_materials_mdl", GltfTier::unsupported},
});

/// Also for one that nobody has heard of.
GltfExtension find_extension(std::string_view name) {
  const std::span<const GltfExtension> all = gltf_extensions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& row) { return row.name == name; });
  return found == all.end() ? GltfExtension{name, GltfTier::unsupported} : *found;
}

}  // namespace

std::string_view GltfExtension::tier_word() const {
  switch (tier) {
    case GltfTier::full:
      return missing_package.empty() ? "full" : "unavailable";
    case GltfTier::partial:
      return missing_package.empty() ? "partial" : "unavailable";
    case GltfTier::harmless:
      return "ignored";
    case GltfTier::experimental:
      return "experimental";
    case GltfTier::unsupported:
      break;
  }
  return "unsupported";
}

std::string GltfExtension::explanation() const {
  if (missing_package.empty()) return std::string(remark);
  return "this build has no " + std::string(missing_package) + (remark.empty() ? "" : "; " + std::string(remark));
}

std::span<const GltfExtension> gltf_extensions() {
  static const std::vector<GltfExtension> all = gltf_extensions_with(can_read);
  return all;
}

std::vector<GltfExtension> gltf_extensions_with(const std::function<bool(ImageFormat)>& has_reader) {
  std::vector<GltfExtension> all(table.begin(), table.end());
  for (GltfExtension& row : all) {
    if (!row.image || has_reader(*row.image)) continue;
    row.missing_package = *row.image == ImageFormat::avif ? "OpenImageIO with libheif" : "OpenImageIO with libwebp";
  }
  return all;
}

bool is_supported_gltf_extension(std::string_view extension, Experiments experiments) {
  return find_extension(extension).is_honoured() || is_turned_on(extension, experiments);
}

bool is_harmless_gltf_extension(std::string_view extension) {
  return find_extension(extension).tier == GltfTier::harmless;
}

std::string why_gltf_extension_is_ignored(std::string_view extension) {
  const GltfExtension row = find_extension(extension);
  if (!row.missing_package.empty()) return "ignored: this build has no " + std::string(row.missing_package);
  if (row.tier == GltfTier::experimental) return "ignored: " + row.explanation();
  return "not supported and ignored";
}

std::optional<NotHonoured> what_is_not_honoured(const std::string& extension, Experiments experiments) {
  const GltfExtension row = find_extension(extension);
  const std::string explanation = row.explanation();
  if ((row.tier == GltfTier::full && row.missing_package.empty()) || is_turned_on(extension, experiments)) return {};
  return NotHonoured{extension, std::string(row.tier_word()) + (explanation.empty() ? "" : ": " + explanation)};
}

std::vector<NotHonoured> parts_not_honoured(const GltfContents& contents, bool has_point_radius) {
  std::vector<NotHonoured> parts;
  const auto add = [&](bool is_there, const char* what, const char* why) {
    if (is_there) parts.push_back({what, why});
  };
  const char* const reason = "not shown without --point-radius";
  add(contents.point_primitives > 0 && !has_point_radius, "primitives of points", reason);
  add(contents.line_primitives > 0 && !has_point_radius, "primitives of lines", reason);
  return parts;
}

void refuse_unknown_gltf_extensions(const std::vector<std::string>& required, const std::string& name,
                                    Experiments experiments) {
  std::string missing, remedy;
  int count = 0;
  for (const std::string& extension : required) {
    const GltfExtension row = find_extension(extension);
    if (row.tier == GltfTier::harmless || is_supported_gltf_extension(extension, experiments)) continue;
    missing += (count++ == 0 ? "" : ", ") + printable(extension);
    if (row.missing_package.empty()) continue;
    missing += " (this build has no " + std::string(row.missing_package) + ")";
    remedy = "build candil with that package, or ";
  }
  if (count == 0) return;
  throw InputError(name, "extensionsRequired",
                   missing + (count == 1 ? " is" : " are") + " not supported; " + remedy + "export the file without " +
                       (count == 1 ? "it" : "them"));
}

}  // namespace candil
