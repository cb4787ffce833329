/// Points and lines as surfaces that rays can hit: spheres and tubes with round joints, of triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene.h"

namespace candil {

/// The primitives of glTF without surfaces (specification, section 3.7.2.1).
enum class ThinMode { points, lines, line_strip, line_loop };

/// How many points or segments so many corners make.
std::size_t thin_count(ThinMode mode, std::size_t corner_count);

/// Two ends by their vertices, the second one twice; a point is all three.
std::vector<Triangle> make_thin(ThinMode mode, const std::vector<std::uint32_t>& corners);

/// How finely spheres are made: each step has four times as many triangles. As fine as goes with so many.
struct ThickDetail {
  int subdivisions = 0;
  std::size_t triangles = 0, vertices = 0;  ///< That make_thick() will make.
};
ThickDetail choose_thick_detail(std::size_t vertex_count, std::size_t segment_count);

/// A sphere around every vertex of `mesh` and a tube along every one of its "triangles" that has two ends, all of
/// `radius` in metres once `to_world`, which must have an inverse, has been applied: the surface is that of spheres and
/// cylinders seen through the inverse. The mean over all directions of the silhouette of a sphere is pi radius^2, of
/// the width of a tube 2 radius. Normals are smooth; uvs and colours are those of the ends, interpolated along tubes.
void make_thick(Mesh& mesh, float radius, const Mat3& to_world, ThickDetail detail);

}  // namespace candil
