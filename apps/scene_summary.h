/// Counts and sizes of a scene, for `candil info`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/scene.h"

namespace candil {

struct SceneSummary {
  std::size_t meshes = 0, objects = 0, instances = 0, materials = 0;
  std::size_t spheres = 0, discs = 0, planes = 0;
  std::size_t triangles = 0;            ///< Stored once each.
  std::size_t instanced_triangles = 0;  ///< Counted once per instance.
  std::size_t vertices = 0;
  std::size_t geometry_bytes = 0;  ///< Vertices and triangles, the acceleration structure not counted.
  std::size_t texture_bytes = 0;
  std::size_t emissive_triangles = 0;  ///< Counted once per instance; unlit surfaces are no lights.
  std::size_t emissive_shapes = 0;     ///< Likewise.
  std::size_t point_lights = 0, spot_lights = 0, directional_lights = 0;
  bool has_environment = false;
  Bounds bounds;

  /// Geometry alone; 0 without triangles.
  double bytes_per_triangle() const;
};

SceneSummary summarize(const Scene& scene);

}  // namespace candil
