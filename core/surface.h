/// Everything about a hit that shading needs, looked up once.
#pragma once

#include "core/ray.h"
#include "core/scene.h"

namespace candil {

/// A point on a surface, world space. Normals are on the front side, whichever side the ray came from.
struct SurfacePoint {
  Vec3 position{0.0f};
  float offset = 0;  ///< Metres to step off the surface so that rays do not hit it again (see offset_origin()).
  Vec3 normal_geometric{0, 1, 0};  ///< Unit, of the flat triangle.
  std::uint32_t material = 0;
  Vec3 normal{0, 1, 0};  ///< Unit, interpolated; the flat one where the mesh has none.
  std::uint32_t instance = 0;
  Vec4 tangent{0.0f};            ///< xyz unit; w: bitangent = w cross(normal, tangent). Zero if the mesh has none.
  Vec4 color{1.0f};              ///< Vertex colour, white if absent.
  Vec2 uv[2]{Vec2(0), Vec2(0)};  ///< Zero unless the material is_textured().
  std::uint32_t mesh = 0, triangle = 0;
};

/// Looks up what `hit` names. The position is interpolated from the vertices: its error does not grow with the
/// length of the ray.
SurfacePoint make_surface_point(const Scene& scene, const Hit& hit);

/// Starts to fetch what prefetch_surface_point() reads, for callers that have other work to do before.
inline void prefetch_triangle(const Scene& scene, const Hit& hit) {
  __builtin_prefetch(&scene.meshes[hit.mesh].triangles[hit.triangle]);
}
/// Starts to fetch what make_surface_point() reads.
inline void prefetch_surface_point(const Scene& scene, const Hit& hit) {
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Triangle& triangle = mesh.triangles[hit.triangle];
  for (int corner = 0; corner < 3; ++corner) {
    __builtin_prefetch(mesh.positions.data() + triangle[corner]);
    __builtin_prefetch(mesh.normals.data() + triangle[corner]);
  }
}

/// Where a ray that leaves `point` along `direction` starts: on the side of the flat triangle that it leaves to. The
/// one place where self-intersection is dealt with. The step is 2^-18 of the largest coordinate that took part in
/// computing the point (triangle vertices, carried through the instance's transform), 16 times the rounding error of
/// that computation and of Embree's plane distance; it is scale-free and needs no epsilon of the scene.
inline Vec3 offset_origin(const SurfacePoint& point, Vec3 direction) {
  const float side = glm::dot(direction, point.normal_geometric) < 0 ? -1.0f : 1.0f;
  return point.position + (side * point.offset) * point.normal_geometric;
}

/// The smallest step of which a coordinate of that magnitude allows 16 times its rounding error.
inline float surface_offset(float largest_coordinate) { return 0x1p-18f * largest_coordinate; }

}  // namespace candil
