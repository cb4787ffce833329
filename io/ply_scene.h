/// A PLY file as a scene of its own.
#pragma once

#include <filesystem>

#include "io/load_scene.h"

namespace candil {

/// One mesh with the normals of the file, or smooth ones with edges sharp above 40 degrees where it has none; in the
/// default material, or in the colours of the vertices. Throws InputError.
LoadedScene load_ply_scene(const std::filesystem::path& path);

}  // namespace candil
