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
  std::uint32_t mesh = 0, triangle = 0;  ///< As in Hit: invalid_id and the shape where the point is on one.
  float bulge = 0;  ///< Metres that the surface meant by the normals is in front of the triangle; < 0: behind it.
  bool is_smooth = false;  ///< There is such a surface (see face_viewer()).

  bool is_on_shape() const { return mesh == invalid_id; }
  /// Decides which side of the surface a direction is on.
  Vec3 normal_of_sides() const { return is_smooth ? normal : normal_geometric; }
};

/// Looks up what `hit` names. The position is interpolated from the vertices: its error does not grow with the
/// length of the ray.
SurfacePoint make_surface_point(const Scene& scene, const Hit& hit);

/// The first set of texture coordinates there, whether or not the material has a texture; zero for a mesh without.
Vec2 first_texture_coordinates(const Scene& scene, const Hit& hit);

/// Puts the point where light meets the smooth surface that the normals of a mesh stand for, as seen from `wo`; a point
/// without such a surface stays as it is. To be called between make_surface_point() and what starts rays there.
///
/// Shading ends where the interpolated normal turns away from the light, but flat triangles turn away one by one, and
/// shade themselves: the edge of the light would follow their sides. Where the surface bulges towards the viewer, the
/// point therefore moves from the triangle to a surface that is curved like the normals (Hanika 2021, "Hacking the
/// Shadow Terminator", Ray Tracing Gems II, chapter 4), and the interpolated normal decides on which side of it a
/// direction is. Not for transmissive materials, whose two sides need the same boundary, nor where a vertex normal is
/// more than 53 degrees off the triangle's: that does not look like a smooth surface.
inline void face_viewer(SurfacePoint& point, Vec3 wo) {
  if (!point.is_smooth) return;
  const float side = glm::dot(point.normal_geometric, wo) < 0 ? -1.0f : 1.0f;
  point.position += glm::max(0.0f, side * point.bulge) * side * point.normal_geometric;
  // At the outline the viewer sees a triangle although the smooth surface has turned away.
  constexpr float least_cosine = 1e-3f;
  const float cosine = side * glm::dot(point.normal, wo);
  if (cosine < least_cosine) point.normal = glm::normalize(point.normal + (side * (least_cosine - cosine)) * wo);
}

/// Starts to fetch what prefetch_surface_point() reads, for callers that have other work to do before.
inline void prefetch_triangle(const Scene& scene, const Hit& hit) {
  if (hit.is_shape()) return;
  __builtin_prefetch(&scene.meshes[hit.mesh].triangles[hit.triangle]);
}
/// Starts to fetch what make_surface_point() reads.
inline void prefetch_surface_point(const Scene& scene, const Hit& hit) {
  if (hit.is_shape()) return;
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Triangle& triangle = mesh.triangles[hit.triangle];
  for (int corner = 0; corner < 3; ++corner) {
    __builtin_prefetch(mesh.positions.data() + triangle[corner]);
    __builtin_prefetch(mesh.normals.data() + triangle[corner]);
  }
}

/// Where a ray that leaves `point` along `direction` starts: on the side of the surface that it leaves to. The
/// one place where self-intersection is dealt with. The step is 2^-18 of the largest coordinate that took part in
/// computing the point (triangle vertices, carried through the instance's transform), 16 times the rounding error of
/// that computation and of Embree's plane distance; it is scale-free and needs no epsilon of the scene.
inline Vec3 offset_origin(const SurfacePoint& point, Vec3 direction) {
  const float side = glm::dot(direction, point.normal_of_sides()) < 0 ? -1.0f : 1.0f;
  return point.position + (side * point.offset) * point.normal_geometric;
}

/// The smallest step of which a coordinate of that magnitude allows 16 times its rounding error.
inline float surface_offset(float largest_coordinate) { return 0x1p-18f * largest_coordinate; }

}  // namespace candil
