/// Tangents for meshes that bring none, by the convention of MikkTSpace, which glTF (section 3.7.2.1) asks for.
#pragma once

#include "core/scene.h"

namespace candil {

/// Fills mesh.tangents from positions, normals (the flat ones where the mesh has none) and mesh.uvs[uv_set], which must
/// not be empty. Vertices that equal each other in all three share a tangent; a vertex is duplicated where triangles of
/// opposite uv orientation meet in it. Triangles of a flat mesh get vertices of their own.
///
/// Convention (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited"): the tangent is the direction of growing u,
/// averaged over the triangles of the vertex, weighted by their angles there, orthogonal to the normal. tangent.w is
/// chosen such that w cross(normal, tangent) is the direction of decreasing glTF v, the "up" of the image.
void generate_tangents(Mesh& mesh, int uv_set);

/// Likewise from the coordinates at which `slot` is looked up, its transform applied: a transform gives the picture
/// that transformed coordinates would.
void generate_tangents(Mesh& mesh, const TextureSlot& slot);

}  // namespace candil
