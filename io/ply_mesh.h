/// From the rows of a PLY file to a mesh.
#pragma once

#include <string>
#include <vector>

#include "core/scene.h"
#include "io/ply_data.h"

namespace candil {

/// Triangles over the vertices that they use, with the attributes of the file. Throws InputError for a position that
/// cannot be used.
Mesh make_ply_mesh(const PlyData& data, const std::string& file, std::vector<std::string>& warnings);

}  // namespace candil
