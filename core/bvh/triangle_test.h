/// Where a ray meets a triangle, without gaps between triangles that share vertices.
///
/// Whether: Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Vertices are moved into the ray's
/// frame, where the ray is the axis: subtract the origin, then shear along the largest component of the direction.
/// There a triangle is hit if the origin of the plane is inside of it, which three edge functions b.x c.y - b.y c.x
/// tell.
/// - The frame depends on the ray alone: a vertex lands in one place, whichever triangle asks. That place is rounded,
///   but the same for all, so that a closed surface stays closed.
/// - Products and differences round monotonically: the sign of an edge function is right or lost (0), never wrong, and
///   swapping the two vertices changes nothing but the sign. Where it is lost it is computed again in double precision,
///   where the products are exact. So the decision is that of exact arithmetic on the rounded places; what is on an
///   edge or a vertex counts as inside of all triangles there.
/// Hence a ray from inside of a closed surface always hits, also through edges and vertices: in the plane the front
/// part of the surface covers the axis in an odd number of layers, and exact inside tests cannot all deny that.
/// (Edge functions of the Pluecker form, Davidovic et al. 2012, are antisymmetric too but may have the wrong sign;
/// around a vertex all triangles can agree that the ray is on the outer side.)
///
/// Where: from the vertices themselves in double precision, so that t and barycentric coordinates are as exact as
/// floats can say, for long and large triangles too. Few triangles get that far. Seen almost edge-on, t is kept between
/// those of the vertices.
///
/// How far the place of a vertex is off: with u = 2^-24, vertex minus origin (a, c) along one axis of the plane and
/// the shear axis, and shear s, |s| <= 1, the result is a - s c up to u |a| + 3 u |s c| + u |a - s c|, which is at most
/// 2 u |a| + 4 u |s c|. core/bvh/box_test.h builds on that.
#pragma once

#include <algorithm>
#include <cmath>

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

  Vec3 origin, direction;
  int x = 0, y = 1, z = 2;  ///< Cyclic permutation of the axes; z is the largest component of the direction.
  Real shear_x = 0, shear_y = 0, inverse_z = 0;

  explicit RayFrame(const Ray& ray) : origin(ray.origin), direction(ray.direction) {
    const Vec3 size = glm::abs(direction);
    z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    x = (z + 1) % 3, y = (z + 2) % 3;
    const Vector d(direction);
    shear_x = d[x] / d[z], shear_y = d[y] / d[z], inverse_z = 1 / d[z];
  }

  /// Position in the frame: x and y across the ray, z the ray's t.
  Vector place(Vec3 vertex) const {
    const Vector p = Vector(vertex) - Vector(origin);
    return {p[x] - shear_x * p[z], p[y] - shear_y * p[z], inverse_z * p[z]};
  }
};

/// The edge functions of a triangle's places in double precision, where their products are exact and their signs right.
/// Divided by their sum they are the weights of the vertices on the axis.
struct EdgeFunctions {
  double u, v, w;

  EdgeFunctions(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c)
      : u(b.x * c.y - b.y * c.x), v(c.x * a.y - c.y * a.x), w(a.x * b.y - a.y * b.x) {}
  double sum() const { return u + v + w; }
  /// Whether the axis passes through the triangle. Not if it is degenerate, seen edge-on or not a number.
  bool is_passed() const {
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    return std::abs(sum()) > 0;
  }
};

/// A triangle that the ray passes through.
struct PassedTriangle {
  Vec3 vertices[3];
  glm::dvec3 places[3];       ///< In the frame of the ray.
  bool is_counter_clockwise;  ///< There.
};

/// Where it is crossed, if at t in [0, t_max] (Moeller and Trumbore 1997).
template <typename Real>
bool locate_crossing(const RayFrame<Real>& frame, const PassedTriangle& triangle, float t_max,
                     TriangleCrossing& crossing) {
  const auto& [place_a, place_b, place_c] = triangle.places;
  const double t_low = std::min({place_a.z, place_b.z, place_c.z}),
               t_high = std::max({place_a.z, place_b.z, place_c.z});
  if (t_low > t_max || t_high < 0) return false;
  const glm::dvec3 a(triangle.vertices[0]), direction(frame.direction);
  const glm::dvec3 edge_b = glm::dvec3(triangle.vertices[1]) - a, edge_c = glm::dvec3(triangle.vertices[2]) - a;
  const glm::dvec3 from_a = glm::dvec3(frame.origin) - a, normal = glm::cross(edge_b, edge_c);
  const double scale = -1 / glm::dot(direction, normal), plane_t = scale * glm::dot(from_a, normal);
  const double t = plane_t > t_low ? std::min(plane_t, t_high) : t_low;  // t_low, too, where it is not a number
  if (!(t >= 0 && t <= t_max)) return false;
  const glm::dvec3 moment = glm::cross(from_a, direction);
  double b = scale * glm::dot(edge_c, moment), c = -scale * glm::dot(edge_b, moment);
  if (!(b >= 0 && c >= 0 && b + c <= 1)) {
    // Outside of an edge by less than the places were rounded.
    const EdgeFunctions edges(place_a, place_b, place_c);
    b = edges.v / edges.sum(), c = edges.w / edges.sum();
  }
  crossing = {static_cast<float>(t), Vec2(b, c), triangle.is_counter_clockwise == (frame.inverse_z < 0)};
  return true;
}

/// The crossing with the triangle (a, b, c), if it is at t in [0, t_max]. Degenerate triangles are never hit.
template <typename Real>
bool cross_triangle(const RayFrame<Real>& frame, Vec3 vertex_a, Vec3 vertex_b, Vec3 vertex_c, float t_max,
                    TriangleCrossing& crossing) {
  const auto a = frame.place(vertex_a), b = frame.place(vertex_b), c = frame.place(vertex_c);
  const Real u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
  bool is_counter_clockwise = u > 0;
  const bool is_sure = u * v > 0 && u * w > 0;
  if (!is_sure) {
    const EdgeFunctions edges(a, b, c);
    if (!edges.is_passed()) return false;
    is_counter_clockwise = edges.sum() > 0;
  }
  return locate_crossing(frame, {{vertex_a, vertex_b, vertex_c}, {a, b, c}, is_counter_clockwise}, t_max, crossing);
}

}  // namespace candil
