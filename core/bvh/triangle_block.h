/// Eight triangles at once: Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Why there are no gaps
/// is told in core/bvh/triangle_test.h, which does the same for one.
#pragma once

#include <cmath>

#include "core/bvh/lanes.h"
#include "core/ray.h"

namespace candil {

struct alignas(64) TriangleBlock {
  float vertices[3][3][lane_count];  ///< Vertex, axis, triangle. Unused triangles are not a number.
  std::uint32_t id[lane_count];      ///< Of the triangle in the hierarchy; with filter_bit where hits need a filter.

  static constexpr std::uint32_t filter_bit = 0x80000000;
};
static_assert(sizeof(TriangleBlock) == 320);

inline namespace CANDIL_TARGET {

/// A ray as the axis of a frame: places across it are sheared along its largest component.
struct BlockRay {
  explicit BlockRay(const Ray& ray) {
    const Vec3 size = glm::abs(ray.direction);
    const int axis_z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int axis_x = axis_z == 2 ? 0 : axis_z + 1, axis_y = axis_x == 2 ? 0 : axis_x + 1;
    origin = {ray.origin[axis_x], ray.origin[axis_y], ray.origin[axis_z]};
    const float along = ray.direction[axis_z];
    shear = {ray.direction[axis_x] / along, ray.direction[axis_y] / along};
    inverse_z = 1 / along;
    row_x = axis_x, row_y = axis_y, row_z = axis_z;
  }

  Vec3 origin;  ///< In the order of the rows.
  Vec2 shear;
  float inverse_z;
  int row_x, row_y, row_z;  ///< Which axis is which: a cyclic permutation.
};

/// Where a ray crosses the triangles of a block at t in [0, t_max].
class BlockCrossings {
 public:
  BlockCrossings(const TriangleBlock& block, const BlockRay& ray, float t_max) {
    const Float8 origin_x = splat8(ray.origin.x), origin_y = splat8(ray.origin.y), origin_z = splat8(ray.origin.z);
    const auto from_origin = [&](int corner) -> Vectors {
      const auto& rows = block.vertices[corner];
      return {load8(rows[ray.row_x]) - origin_x, load8(rows[ray.row_y]) - origin_y, load8(rows[ray.row_z]) - origin_z};
    };
    const Float8 shear_x = splat8(ray.shear.x), shear_y = splat8(ray.shear.y);
    const auto place = [&](const Vectors& p) -> Places { return {p.x - shear_x * p.z, p.y - shear_y * p.z}; };
    const Vectors from_a = from_origin(0), from_b = from_origin(1), from_c = from_origin(2);
    const Places a = place(from_a), b = place(from_b), c = place(from_c);
    const Float8 u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
    hits_ = sign_bits((minimum(minimum(u, v), w) >= 0) | (maximum(maximum(u, v), w) <= 0));
    if (hits_ == 0) return;  // two of three blocks, or so

    // The weights u, v, w would give t up to an error as large as that of the most distant vertex. The plane of the
    // triangle (Moeller and Trumbore 1997) gives it up to one of the size of the triangle across its long side.
    const Vectors edge_b = subtract(block, ray, 1), edge_c = subtract(block, ray, 2);
    const Float8 normal_x = edge_b.y * edge_c.z - edge_b.z * edge_c.y,
                 normal_y = edge_b.z * edge_c.x - edge_b.x * edge_c.z,
                 normal_z = edge_b.x * edge_c.y - edge_b.y * edge_c.x;
    const Float8 facing = shear_x * normal_x + shear_y * normal_y + normal_z;
    const Float8 depth = (from_a.x * normal_x + from_a.y * normal_y + from_a.z * normal_z) / facing;
    // Seen almost edge-on it is between the vertices at least; also where the above is not a number.
    const Float8 nearest = minimum(minimum(from_a.z, from_b.z), from_c.z),
                 farthest = maximum(maximum(from_a.z, from_b.z), from_c.z);
    const Float8 t = splat8(ray.inverse_z) * minimum(maximum(depth, nearest), farthest);

    const Float8 sum = u + v + w;
    std::memcpy(t_, &t, sizeof t);
    std::memcpy(v_, &v, sizeof v);
    std::memcpy(w_, &w, sizeof w);
    std::memcpy(sum_, &sum, sizeof sum);
    // Rounding lost a sign, or something overflowed.
    const unsigned unsure = hits_ & sign_bits((u * v == 0) | (w == 0) | (1 / sum == 0));
    if (unsure != 0) [[unlikely]]
      decide_exactly(a, b, c, unsure);
    hits_ &= sign_bits((t >= 0) & (t <= splat8(t_max)));
    is_front_clockwise_ = ray.inverse_z > 0;
  }

  unsigned hits() const { return hits_; }  ///< Bit i: triangle i is hit. The rest is about those that are.
  float t(int lane) const { return t_[lane]; }
  /// Weights of the second and the third vertex.
  Vec2 barycentric(int lane) const { return Vec2(v_[lane], w_[lane]) / sum_[lane]; }
  bool is_front_face(int lane) const { return (sum_[lane] < 0) == is_front_clockwise_; }

 private:
  struct Vectors {
    Float8 x, y, z;
  };
  /// Of a vertex, across the ray.
  struct Places {
    Float8 x, y;
  };
  static Vectors subtract(const TriangleBlock& block, const BlockRay& ray, int corner) {
    const auto difference = [&](int row) { return load8(block.vertices[corner][row]) - load8(block.vertices[0][row]); };
    return {difference(ray.row_x), difference(ray.row_y), difference(ray.row_z)};
  }

  /// In double precision the products of the edge functions are exact and their signs right.
  [[gnu::noinline]] void decide_exactly(const Places& a, const Places& b, const Places& c, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const int i = std::countr_zero(lanes);
      const double ax = a.x[i], ay = a.y[i], bx = b.x[i], by = b.y[i], cx = c.x[i], cy = c.y[i];
      const double u = bx * cy - by * cx, v = cx * ay - cy * ax, w = ax * by - ay * bx, sum = u + v + w;
      const bool is_outside = (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0);
      // A sum of 0: degenerate, or seen edge-on.
      if (is_outside || !(std::abs(sum) > 0)) hits_ &= ~(1U << i);
      v_[i] = static_cast<float>(v / std::abs(sum)), w_[i] = static_cast<float>(w / std::abs(sum));
      sum_[i] = sum < 0 ? -1.0f : 1.0f;
    }
  }

  unsigned hits_;
  bool is_front_clockwise_;  // in the frame
  alignas(32) float t_[lane_count], v_[lane_count], w_[lane_count], sum_[lane_count];
};

}  // namespace CANDIL_TARGET
}  // namespace candil
