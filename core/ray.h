/// What is asked of an accelerator, and what it answers.
#pragma once

#include "core/math.h"

namespace candil {

struct Ray {
  Vec3 origin{0.0f};         ///< Metres, world space.
  Vec3 direction{0, 0, -1};  ///< Unit length.
  float t_max = infinity;    ///< Hits at [0, t_max] count; metres.
};

/// Only ids and the place on the primitive; make_surface_point() looks up the rest for the hits that are shaded.
struct Hit {
  float t = infinity;          ///< Metres along the ray.
  Vec2 barycentric{0.0f};      ///< Weights of the triangle's second and third vertex; of a shape, see core/shape.h.
  std::uint32_t instance = 0;  ///< Into Scene::instances; invalid_id for a shape.
  std::uint32_t mesh = 0;      ///< Into Scene::meshes; invalid_id for a shape.
  std::uint32_t triangle = 0;  ///< Into Mesh::triangles, or into Scene::shapes.

  bool is_shape() const { return mesh == invalid_id; }
  /// What Accelerator::intersect_each() leaves of a ray that hits nothing.
  bool is_miss() const { return t == infinity; }
};

}  // namespace candil
