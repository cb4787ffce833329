/// Spheres, discs and infinite planes: where rays meet them, and what is there.
///
/// Coordinates of a point on a shape (`Hit::barycentric`), in the shape's own space: disc and plane: (x, y); sphere:
/// the octahedral map of the unit vector (Cigolle et al. 2014), each in [-1, 1]. Texture coordinates, (0, 0) being the
/// upper left corner of an image:
/// - sphere: u = 1/2 + atan2(z, x) / (2 pi), v = 1/2 - asin(y) / pi: y is up (the report's equations 22 and 21);
/// - plane: u = x, v = -y: one image per unit, repeated (its figure 27);
/// - disc: u = (1 + x) / 2, v = (1 - y) / 2.
/// A shape whose transform is_invertible() does not accept is not there: no ray hits it, it has no bounds.
#pragma once

#include <array>

#include "core/surface.h"

namespace candil {

bool is_invertible(const Affine& transform);

/// Where a ray meets a shape.
struct ShapeCrossing {
  float t = infinity;          ///< Along the ray, metres.
  Vec2 coordinates{0.0f};      ///< See the head of this file.
  bool is_front_face = false;  ///< The ray comes from outside of the sphere, or from +Z.
};

/// At most two, the nearer one first.
struct ShapeCrossings {
  std::array<ShapeCrossing, 2> list;
  int count = 0;

  const ShapeCrossing* begin() const { return list.data(); }
  const ShapeCrossing* end() const { return list.data() + count; }
};

/// A shape with what its intersection needs, in double precision: a far or large shape is hit as exactly as a near one.
/// The same ray always gets the same bits, whichever accelerator asks.
class ShapeIntersector {
 public:
  explicit ShapeIntersector(const Shape& shape);
  /// All crossings with t in [0, t_max], none beyond 2^56 m.
  ShapeCrossings crossings(const Ray& ray, float t_max) const;

 private:
  /// One coordinate of `to_local_ * v`.
  double row_product(int row, glm::dvec3 v) const {
    return to_local_[0][row] * v.x + to_local_[1][row] * v.y + to_local_[2][row] * v.z;
  }

  ShapeKind kind_;
  glm::dmat3 to_local_;
  glm::dvec3 origin_;  // of local space, in world space
};

/// World box, rounded outwards. Empty for a plane, which no box holds.
Bounds shape_bounds(const Shape& shape);

/// What make_surface_point() answers for a hit on a shape. The point is put on the surface again from its coordinates.
/// The tangent is that of u, also without textures; at the poles of a sphere it is the one for u = 1/2.
SurfacePoint shape_surface_point(const Scene& scene, std::uint32_t shape, Vec2 coordinates);

/// Texture coordinates of the point on the shape.
Vec2 shape_texture_coordinates(const Shape& shape, Vec2 coordinates);

/// The octahedral map of the unit sphere. Coordinates beyond [-1, 1] are not allowed.
glm::dvec3 octahedral_to_unit(Vec2 coordinates);
Vec2 unit_to_octahedral(glm::dvec3 v);

/// Material that a hit is on, triangle or shape.
inline std::uint32_t material_of(const Scene& scene, const Hit& hit) {
  return hit.is_shape() ? scene.shapes[hit.triangle].material : scene.meshes[hit.mesh].material;
}

}  // namespace candil
