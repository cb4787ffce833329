/// Where a ray meets a triangle, without gaps between triangles that share vertices: Woop, Benthin and Wald 2013,
/// "Watertight Ray/Triangle Intersection".
///
/// Vertices are moved into the ray's frame, where the ray is the axis: subtract the origin, then shear along the
/// largest component of the direction. There a triangle is hit if the origin of the plane is inside of it, which three
/// edge functions b.x c.y - b.y c.x tell.
/// - The frame depends on the ray alone: a vertex lands in one place, whichever triangle asks. That place is rounded,
///   but the same for all, so that a closed surface stays closed.
/// - Products and differences round monotonically: the sign of an edge function is right or lost (0), never wrong, and
///   swapping the two vertices changes nothing but the sign. Where it is lost it is computed again in double precision,
///   where the products are exact. So the decision is that of exact arithmetic on the rounded places; what is on an
///   edge or a vertex counts as inside of all triangles there.
/// Hence a ray from inside of a closed surface always hits, also through edges and vertices: in the plane the front
/// part of the surface covers the axis in an odd number of layers, and exact inside tests cannot all deny that.
/// Edge functions of the Pluecker form (Davidovic et al. 2012) are antisymmetric too but have wrong signs, with which
/// all triangles around a vertex can agree that the ray is on the outer side.
///
/// How far the place of a vertex is off: with u = 2^-24, vertex minus origin (a, c) along one axis of the plane and
/// the shear axis, and shear s, |s| <= 1, the result is a - s c up to u |a| + 3 u |s c| + u |a - s c|, which is at most
/// 2 u |a| + 4 u |s c|. core/bvh/box_test.h builds on that.
#pragma once

#include <cmath>
#include <utility>

#include "core/ray.h"

namespace candil {

struct TriangleCrossing {
  float t = infinity;      ///< In units of the ray's direction.
  Vec2 barycentric{0.0f};  ///< Weights of the second and third vertex.
  bool is_front_face = false;
};

/// The frame of a ray in which it is the third axis. `Real` is float for traversal, double for the oracle.
template <typename Real>
struct RayFrame {
  using Vector = glm::vec<3, Real>;

  Vector origin;
  int x = 0, y = 1, z = 2;  ///< Cyclic permutation of the axes; z is the largest component of the direction.
  Real shear_x = 0, shear_y = 0, inverse_z = 0;

  explicit RayFrame(const Ray& ray) : origin(ray.origin) {
    const Vec3 size = glm::abs(ray.direction);
    z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x = (z + 1) % 3, y = (z + 2) % 3;
    const Vector direction(ray.direction);
    shear_x = direction[x] / direction[z], shear_y = direction[y] / direction[z], inverse_z = 1 / direction[z];
  }

  /// Position in the frame: x and y across the ray, z the ray's t.
  Vector place(Vec3 vertex) const {
    const Vector p = Vector(vertex) - origin;
    return {p[x] - shear_x * p[z], p[y] - shear_y * p[z], inverse_z * p[z]};
  }
  /// Whether a triangle that turns that way in the frame shows the ray its front, counter-clockwise side.
  bool is_front(bool is_counter_clockwise) const { return is_counter_clockwise == (inverse_z < 0); }
};

/// The crossing with the triangle of these three places, if it is at t in [0, t_max]: in double precision.
template <typename Real>
bool cross_places_exactly(const RayFrame<Real>& frame, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, float t_max,
                          TriangleCrossing& crossing) {
  const double u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  const double sum = u + v + w;
  if (!(std::abs(sum) > 0)) return false;  // degenerate, seen edge-on, or not a number
  const double t = (u * a.z + v * b.z + w * c.z) / sum;
  if (!(t >= 0 && t <= t_max)) return false;
  crossing = {static_cast<float>(t), Vec2(glm::dvec2(v, w) / sum), frame.is_front(sum > 0)};
  return true;
}

/// The crossing with the triangle (a, b, c), if it is at t in [0, t_max]. Degenerate triangles are never hit.
inline bool cross_triangle(const RayFrame<float>& frame, Vec3 vertex_a, Vec3 vertex_b, Vec3 vertex_c, float t_max,
                           TriangleCrossing& crossing) {
  const Vec3 a = frame.place(vertex_a), b = frame.place(vertex_b), c = frame.place(vertex_c);
  const float u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  const float sum = u + v + w;
  const bool is_sure = u * v != 0 && w != 0 && std::abs(sum) < infinity;
  if (!is_sure) return cross_places_exactly(frame, a, b, c, t_max, crossing);
  const float scale = 1 / sum;
  const Vec2 barycentric = scale * Vec2(v, w);
  const float t = scale * u * a.z + barycentric.x * b.z + barycentric.y * c.z;
  if (!(t >= 0 && t <= t_max)) return false;
  crossing = {t, barycentric, frame.is_front(sum > 0)};
  return true;
}

/// The same in double precision throughout.
inline bool cross_triangle(const RayFrame<double>& frame, Vec3 vertex_a, Vec3 vertex_b, Vec3 vertex_c, float t_max,
                           TriangleCrossing& crossing) {
  return cross_places_exactly(frame, frame.place(vertex_a), frame.place(vertex_b), frame.place(vertex_c), t_max,
                              crossing);
}

}  // namespace candil
