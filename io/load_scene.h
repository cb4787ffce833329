/// Reads a scene file of any supported kind; the kind is told by its first bytes and its extension.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.h"

namespace candil {

struct LoadedScene {
  Scene scene;                        ///< Baked (bake_single_instances()) and valid: renderers need no further check.
  std::vector<std::string> warnings;  ///< One line each; oddities that do not stop a render.
  std::vector<std::string> extensions_used;         ///< As the file lists them, sorted.
  std::vector<std::string> extensions_unsupported;  ///< Those of them that were ignored.
};

/// Loads .gltf and .glb. Throws InputError when the file cannot be used.
LoadedScene load_scene(const std::filesystem::path& path);

}  // namespace candil
