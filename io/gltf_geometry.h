/// Triangles and vertices from what glTF primitives say, and repairs of attributes that no renderer could use.
#pragma once

#include <cstddef>
#include <vector>

#include "core/scene.h"
#include "io/gltf_accessor.h"

namespace candil {

enum class TriangleMode { list, strip, fan };

/// How many triangles so many corners make (specification, section 3.7.2.1).
std::size_t triangle_count(TriangleMode mode, std::size_t corner_count);

/// Triangles over the vertices that `indices` name, or over vertices in order. Strips and fans may restart by repeating
/// vertices; the empty triangles of that are left out.
std::vector<Triangle> make_triangles(TriangleMode mode, const std::vector<std::uint32_t>& indices);
std::vector<Triangle> make_triangles(TriangleMode mode, std::size_t vertex_count);

/// The vertices that `triangles` use; renumbers the triangles accordingly. Costs no more than a small multiple of the
/// number of triangles, however many vertices there are.
VertexSelection select_vertices(std::vector<Triangle>& triangles, std::size_t vertex_count);

/// Makes all normals unit vectors; those that have no direction (zero, not finite) get that of a triangle there. True
/// if there were any.
bool repair_normals(Mesh& mesh);

/// Makes all tangents unit vectors with w = +1 or -1; those without a direction get one that is perpendicular to the
/// normal. True if there were any.
bool repair_tangents(Mesh& mesh);

}  // namespace candil
