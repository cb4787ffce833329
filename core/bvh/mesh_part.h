/// What a hierarchy of triangles is built from, and what it answers.
#pragma once

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

}  // namespace candil
