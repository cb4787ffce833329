/// Stanford PLY meshes: ascii, binary little and big endian.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene.h"

namespace candil {

/// Where the vertex normals of a mesh come from.
enum class NormalSource : std::uint8_t {
  file,    ///< Those of the file; flat shading where it has none.
  smooth,  ///< Computed: mean of the faces around a vertex that meet below the crease angle.
  flat,    ///< None: every triangle is shaded by its own plane.
};

struct PlyOptions {
  NormalSource normals = NormalSource::file;
  float crease_angle = pi;  ///< Radians; `smooth` keeps an edge sharp where its two faces turn by more than this.
};

/// The faces and triangle strips of the file as triangles of material 0 (polygons are split into triangles) over the
/// vertices that they use, with normals, texture coordinates and colours where the file has them. PLY has (0, 0) at the
/// lower left corner of an image: v becomes 1 - v. Colours of integer types are sRGB, others linear. A file without
/// faces gives an empty mesh and a warning. Throws InputError with the place in the file ("element vertex, row 17"; the
/// first row is 0) when it is truncated, its counts lie, an index is out of range, or a position is not finite.
Mesh load_ply(const std::filesystem::path& path, const PlyOptions& options, std::vector<std::string>& warnings);

}  // namespace candil
