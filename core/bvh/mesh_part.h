/// What a hierarchy of triangles is built from, and what it answers.
#pragma once

#include <span>
#include <vector>

#include "core/scene.h"

namespace candil {

/// One mesh among those that a hierarchy covers. The mesh must outlive the hierarchy.
struct MeshPart {
  const Mesh* mesh = nullptr;
  std::uint32_t mesh_id = 0;            ///< Into Scene::meshes.
  std::uint32_t instance = invalid_id;  ///< Into Scene::instances; invalid_id: shared by several.
  bool needs_filter = false;            ///< Hits on it count only if `accept` says so.
};

/// The nearest hit so far. A search starts with `t` at the end of the ray and with no part.
struct TriangleHit {
  float t = infinity;               ///< In units of the ray's direction.
  Vec2 barycentric{0.0f};           ///< Weights of the triangle's second and third vertex.
  std::uint32_t part = invalid_id;  ///< Index of the MeshPart; invalid_id: nothing was hit.
  std::uint32_t triangle = 0;       ///< Into Mesh::triangles.
};

/// Which triangle of which part.
struct TriangleId {
  std::uint32_t part = 0, triangle = 0;
};

/// Triangles with their boxes, both of one length.
struct TriangleList {
  std::vector<TriangleId> ids;
  std::vector<Bounds> bounds;  ///< With the margin of core/bvh/box_test.h.
};

/// All triangles of the parts that a ray can hit, in order: those of three different corners without a coordinate that
/// is not finite.
TriangleList list_triangles(std::span<const MeshPart> parts);

/// Its three vertices.
struct Corners {
  Vec3 a, b, c;
};
inline Corners corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const Triangle t = mesh.triangles[triangle];
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

}  // namespace candil
