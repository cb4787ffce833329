/// Vertex normals for meshes that come without.
#pragma once

#include <span>

#include "core/scene.h"

namespace candil {

/// Gives corners of one vertex that are in different groups different vertices, with the same attributes. `groups` has
/// a number for every corner, corner c of triangle t at 3 t + c.
void split_vertices(Mesh& mesh, std::span<const std::uint32_t> groups);

/// Replaces the normals by the mean of the faces around each vertex, weighted by their angle there (Thuermer and
/// Wuethrich 1998). Faces count as neighbours where they share an edge and turn by no more than `crease_angle`
/// (radians) across it; vertices are doubled where they do not. Vertices at the same position count as one. At most 1.4
/// billion triangles.
void compute_smooth_normals(Mesh& mesh, float crease_angle);

}  // namespace candil
