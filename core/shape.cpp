#include "core/shape.h"

#include <algorithm>
#include <cmath>

namespace candil {
namespace {

/// Metres. A ray that nearly runs along a plane meets it beyond all scenes, and the next one from there would be too
/// far out for Embree, which ends the program above about 1e18: such a ray sees the horizon instead.
constexpr double longest_ray = 0x1p56;

double max_component(glm::dvec3 v) { return std::max({v.x, v.y, v.z}); }

Vec2 texture_coordinates(ShapeKind kind, glm::dvec3 local) {
  const Vec3 p(local);
  switch (kind) {
    case ShapeKind::sphere:
      // The arc sine of y, exact at the poles too.
      return {0.5f + std::atan2(p.z, p.x) / (2 * pi), 0.5f - std::atan2(p.y, std::hypot(p.x, p.z)) / pi};
    case ShapeKind::disc:
      return {0.5f * (1 + p.x), 0.5f * (1 - p.y)};
    case ShapeKind::plane:
      return {p.x, -p.y};
  }
  return Vec2(0);
}

glm::dvec3 to_local(ShapeKind kind, Vec2 coordinates) {
  return kind == ShapeKind::sphere ? octahedral_to_unit(coordinates) : glm::dvec3(glm::dvec2(coordinates), 0);
}

/// Towards larger u on the sphere, local space, any length.
glm::dvec3 eastwards(glm::dvec3 on_sphere) {
  if (on_sphere.x == 0 && on_sphere.z == 0) return {0, 0, 1};
  return {-on_sphere.z, 0, on_sphere.x};
}

}  // namespace

bool is_invertible(const Affine& transform) {
  const double determinant = glm::determinant(glm::dmat3(transform.linear));
  return determinant != 0 && std::isfinite(determinant) && is_finite(transform.translation);
}

ShapeIntersector::ShapeIntersector(const Shape& shape)
    : kind_(shape.kind),
      to_local_(glm::inverse(glm::dmat3(shape.to_world.linear))),
      origin_(shape.to_world.translation) {}

ShapeCrossings ShapeIntersector::crossings(const Ray& ray, float t_max) const {
  const glm::dvec3 from_origin = glm::dvec3(ray.origin) - origin_, towards(ray.direction);
  const double t_end = std::min<double>(t_max, longest_ray);
  ShapeCrossings found;
  if (kind_ == ShapeKind::sphere) {
    const glm::dvec3 origin = to_local_ * from_origin, direction = to_local_ * towards;
    // From the point of the line that is nearest to the centre: no cancellation however far the origin is (Haines et
    // al. 2019, "Precision Improvements for Ray/Sphere Intersection").
    const double squared = glm::dot(direction, direction), middle = -glm::dot(origin, direction) / squared;
    const glm::dvec3 nearest = origin + middle * direction;
    const double half = std::sqrt((1 - glm::dot(nearest, nearest)) / squared);
    for (const double to_side : {-half, half}) {
      const double t = middle + to_side;  // not a number where the line passes by
      if (!(t >= 0 && t <= t_end)) continue;
      const Vec2 coordinates = unit_to_octahedral(nearest + to_side * direction);
      found.list[found.count++] = {static_cast<float>(t), coordinates, to_side < 0};
    }
    return found;
  }
  // Most planes are beyond something nearer: one row of the transform tells.
  const double height = row_product(2, from_origin), rise = row_product(2, towards);
  const double t = -height / rise;
  if (!(t >= 0 && t <= t_end)) return found;
  const glm::dvec2 on(row_product(0, from_origin) + t * row_product(0, towards),
                      row_product(1, from_origin) + t * row_product(1, towards));
  const bool is_there = kind_ == ShapeKind::plane ? std::abs(on.x) + std::abs(on.y) < 0x1p127 : glm::dot(on, on) <= 1;
  if (is_there) found.list[found.count++] = {static_cast<float>(t), Vec2(on), rise < 0};
  return found;
}

Bounds shape_bounds(const Shape& shape) {
  Bounds bounds;
  if (shape.kind == ShapeKind::plane || !is_invertible(shape.to_world)) return bounds;
  const glm::dmat3 rows = glm::transpose(glm::dmat3(shape.to_world.linear));
  for (int axis = 0; axis < 3; ++axis) {
    // The furthest that a unit vector (of the xy plane) gets along the axis is the length of that row.
    const double reach =
        shape.kind == ShapeKind::sphere ? glm::length(rows[axis]) : glm::length(glm::dvec2(rows[axis]));
    const double center = shape.to_world.translation[axis];
    bounds.low[axis] = std::nextafter(static_cast<float>(center - reach), -infinity);
    bounds.high[axis] = std::nextafter(static_cast<float>(center + reach), infinity);
  }
  return bounds;
}

SurfacePoint shape_surface_point(const Scene& scene, std::uint32_t id, Vec2 coordinates) {
  const Shape& shape = scene.shapes[id];
  const bool is_sphere = shape.kind == ShapeKind::sphere;
  const glm::dmat3 to_world(shape.to_world.linear);
  const glm::dvec3 translation(shape.to_world.translation);
  const glm::dvec3 local = to_local(shape.kind, coordinates);
  const glm::dvec3 position = to_world * local + translation;
  const glm::dvec3 normal = is_sphere ? local : glm::dvec3(0, 0, 1);
  const glm::dvec3 tangent = is_sphere ? eastwards(local) : glm::dvec3(1, 0, 0);

  SurfacePoint point;
  point.instance = point.mesh = invalid_id;
  point.triangle = id;
  point.material = shape.material;
  point.position = Vec3(position);
  point.normal_geometric = Vec3(glm::normalize(normal_matrix(to_world) * normal));
  point.normal = point.normal_geometric;
  // v runs downwards in an image: the bitangent is its way up. East of a globe is to the left of who looks at it.
  const bool is_mirrored = (glm::determinant(to_world) < 0) != is_sphere;
  point.tangent = Vec4(Vec3(glm::normalize(to_world * tangent)), is_mirrored ? -1.0f : 1.0f);
  if (scene.materials[shape.material].is_textured()) {
    point.uv[0] = point.uv[1] = texture_coordinates(shape.kind, local);
  }
  // All was computed in double precision: what counts is the rounding of the result, and far below it that of the terms
  // that may have cancelled out.
  glm::dvec3 terms = glm::abs(translation);
  for (int axis = 0; axis < 3; ++axis) terms += glm::abs(to_world[axis]) * std::max(1.0, std::abs(local[axis]));
  const double magnitude = std::max(max_component(glm::abs(position)), 0x1p-24 * max_component(terms));
  point.offset = surface_offset(static_cast<float>(magnitude));
  return point;
}

Vec2 shape_texture_coordinates(const Shape& shape, Vec2 coordinates) {
  return texture_coordinates(shape.kind, to_local(shape.kind, coordinates));
}

glm::dvec3 octahedral_to_unit(Vec2 coordinates) {
  const glm::dvec2 p(coordinates);
  const double z = 1 - std::abs(p.x) - std::abs(p.y), fold = std::max(-z, 0.0);
  return glm::normalize(glm::dvec3(p.x - std::copysign(fold, p.x), p.y - std::copysign(fold, p.y), z));
}

Vec2 unit_to_octahedral(glm::dvec3 v) {
  const glm::dvec2 p = glm::dvec2(v) / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  if (v.z >= 0) return Vec2(p);
  return Vec2(std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y));
}

}  // namespace candil
