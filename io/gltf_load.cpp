#include "io/gltf_accessor.h"
#include "io/gltf_extensions.h"
#include "io/gltf_internal.h"

namespace candil {

namespace {

/// One line for everything in the file that the picture will lack.
void report_unsupported(const GltfDocument& document, LoadedScene& loaded, Warnings& warnings) {
  loaded.contents = document.contents();
  for (const std::string& extension : loaded.contents.extensions_used) {
    if (const auto not_honoured = what_is_not_honoured(extension)) loaded.not_honoured.push_back(*not_honoured);
    if (is_supported_gltf_extension(extension) || is_harmless_gltf_extension(extension)) continue;
    loaded.extensions_unsupported.push_back(extension);
    warnings.add("extension " + printable(extension) + " is not supported and ignored");
  }
  for (NotHonoured& part : parts_not_honoured(loaded.contents)) loaded.not_honoured.push_back(std::move(part));
  if (document.has_animations()) warnings.add("animations are not supported and ignored");
}

}  // namespace

LoadedScene load_gltf(const std::filesystem::path& path, const LoadOptions& options) {
  const GltfDocument document(path);
  LoadedScene loaded;
  Warnings warnings;
  report_unsupported(document, loaded, warnings);

  TextureTable textures(document, loaded.scene, warnings);
  MaterialTable materials(document, loaded.scene, textures, warnings, choose_variant(document, options.variant));
  const std::vector<PlacedNode> nodes = place_nodes(document, options.scene, warnings);
  add_instances(document, nodes, loaded.scene, materials, warnings);
  add_cameras(document, nodes, loaded.scene, warnings);
  add_lights(document, nodes, loaded.scene, warnings);
  check_unused_meshes(document, nodes);
  check_accessors(document);
  loaded.files = document.files();
  for (std::filesystem::path& file : textures.decode_images()) loaded.files.push_back(std::move(file));

  bake_single_instances(loaded.scene);
  loaded.warnings = warnings.take();
  return loaded;
}

}  // namespace candil
