/// An emissive sphere, disc or infinite plane as a light: directions from a point towards it, and their density.
///
/// - Sphere, stretched or not: uniform over the cone of directions in which the point sees it, in the sphere's own
///   space, where it is round; a direction that the transform M makes of the unit vector d there has
///   1/|det M| |M d|^3 times its density. From inside of it the cone is the whole sphere.
/// - Disc, stretched or not: uniform over its area.
/// - Plane: uniform over the hemisphere of directions towards it, 1/(2 pi).
///
/// Points within rounding of the surface of a disc or plane do not see it. Those of a sphere see its inside.
#pragma once

#include <optional>

#include "core/light_sample.h"
#include "core/shape.h"

namespace candil {

class ShapeLight {
 public:
  /// `shape` is an id into Scene::shapes, of an emissive material. The scene must outlive the result.
  ShapeLight(const Scene& scene, std::uint32_t shape);

  /// Estimated luminous power of all sides that shine, finite, for choosing among lights. A plane counts as half an
  /// environment around a scene of that radius (metres). Zero for a shape that is not there.
  float power(float scene_radius) const;

  /// As LightSampler::sample(); `choice` is the probability with which this light was chosen.
  std::optional<LightSample> sample(const SurfacePoint& from, Vec2 u, float choice) const;

  /// Density of sample(), 1/sr and without the choice of the light, for a ray from about `from` that meets the shape
  /// at `on`.
  float pdf(Vec3 from, const SurfacePoint& on) const;

 private:
  /// How a point sees the shape.
  struct View {
    glm::dvec3 from;              // local space
    bool is_front = false;        // the side that it sees
    bool is_visible = false;      // nothing below counts if not
    double height = 0;            // of the point above a disc or plane, at least 0, metres
    double one_minus_cosine = 0;  // of the cone around a sphere
  };
  /// A place on the shape, and the way to it in world space.
  struct Place {
    glm::dvec3 local, towards;
  };
  View view_from(Vec3 from) const;
  double density(const View& view, glm::dvec3 towards) const;
  Place place_on_sphere(const View& view, Vec2 u) const;
  Place place_on_disc(const View& view, Vec2 u) const;
  Place place_on_plane(const View& view, Vec2 u) const;
  Vec2 coordinates_of(glm::dvec3 local) const;
  Vec3 emission_at(const SurfacePoint& on, bool is_front) const;

  const Scene* scene_;
  std::uint32_t shape_;
  ShapeKind kind_;
  bool is_double_sided_;
  ShapeIntersector intersector_;
  glm::dmat3 to_world_, to_local_;
  glm::dvec3 origin_;   // of local space
  glm::dvec3 normal_;   // unit, of a disc or plane
  double determinant_;  // of to_world_, its absolute value
  double area_;         // of a disc, m2
};

}  // namespace candil
