/// What a mesh needs of the rows of a PLY file; everything else in it is skipped.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/ply_header.h"

namespace candil {

/// Lists one behind the other, one per row.
template <typename Value>
struct PlyLists {
  std::vector<std::uint32_t> sizes;
  std::vector<Value> values;
};

struct PlyData {
  std::uint64_t vertex_count = 0;
  std::vector<float> x, y, z;  ///< As many as vertices, as all that are not empty.
  std::vector<float> normal_x, normal_y, normal_z;
  std::vector<float> u, v;                     ///< As in the file: (0, 0) is the lower left corner of an image.
  std::vector<float> red, green, blue, alpha;  ///< As in the file.
  PlyType red_type{}, green_type{}, blue_type{}, alpha_type{};
  PlyLists<std::uint32_t> faces;      ///< Vertices of polygons; all are less than vertex_count.
  PlyLists<float> face_uvs;           ///< u and v of each corner, by turns. Empty, or as many lists as faces.
  PlyLists<std::uint32_t> strips;     ///< Vertices of triangle strips; invalid_id begins a new one.
  std::vector<std::string> left_out;  ///< What the file has for its picture, but candil does not show.
};

/// Throws InputError with element and row (the first one is row 0) where the file is truncated, claims more rows or
/// longer lists than it has bytes for, or where an index is out of range.
PlyData read_ply_data(const PlyHeader& header, std::string_view bytes, const std::string& file,
                      std::vector<std::string>& warnings);

}  // namespace candil
