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
    const auto place = [&](int corner) -> Places {
      const auto& rows = block.vertices[corner];
      const Float8 z = load8(rows[ray.row_z]) - origin_z;
      return {(load8(rows[ray.row_x]) - origin_x) - splat8(ray.shear.x) * z,
              (load8(rows[ray.row_y]) - origin_y) - splat8(ray.shear.y) * z, splat8(ray.inverse_z) * z};
    };
    const Places a = place(0), b = place(1), c = place(2);
    const Float8 u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
    const Int8 is_inside = (minimum(minimum(u, v), w) >= 0) | (maximum(maximum(u, v), w) <= 0);
    const Float8 sum = u + v + w;
    const Float8 scale = 1 / sum;
    const Float8 weight_b = scale * v, weight_c = scale * w;
    const Float8 t = scale * u * a.z + weight_b * b.z + weight_c * c.z;
    // Rounding lost a sign, or something overflowed.
    const Int8 is_unsure = (u * v == 0) | (w == 0) | (scale == 0);
    hits_ = sign_bits(is_inside & (is_unsure | ((t >= 0) & (t <= splat8(t_max)))));
    if (hits_ == 0) return;
    std::memcpy(t_, &t, sizeof t);
    std::memcpy(b_, &weight_b, sizeof weight_b);
    std::memcpy(c_, &weight_c, sizeof weight_c);
    turns_ = sign_bits(sum > 0);
    front_turns_ = ray.inverse_z < 0 ? 0xff : 0;
    const unsigned unsure = hits_ & sign_bits(is_unsure);
    if (unsure != 0) [[unlikely]]
      cross_exactly(a, b, c, t_max, unsure);
  }

  unsigned hits() const { return hits_; }  ///< Bit i: triangle i is hit. The rest is about those that are.
  float t(int lane) const { return t_[lane]; }
  Vec2 barycentric(int lane) const { return {b_[lane], c_[lane]}; }
  bool is_front_face(int lane) const { return ((turns_ ^ front_turns_) >> lane & 1) == 0; }

 private:
  /// Where the eight copies of a vertex are in the frame; z is the t of the ray.
  struct Places {
    Float8 x, y, z;
    glm::dvec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
  };

  /// In double precision, where the products of the edge functions are exact and their signs right.
  [[gnu::noinline]] void cross_exactly(const Places& places_a, const Places& places_b, const Places& places_c,
                                       float t_max, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      const glm::dvec3 a = places_a[lane], b = places_b[lane], c = places_c[lane];
      const double u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
      const double sum = u + v + w, t = (u * a.z + v * b.z + w * c.z) / sum;
      const bool is_outside = (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0);
      const unsigned bit = 1U << lane;
      // A sum of 0: degenerate, or seen edge-on.
      if (is_outside || !(std::abs(sum) > 0) || !(t >= 0 && t <= t_max)) {
        hits_ &= ~bit;
        continue;
      }
      t_[lane] = static_cast<float>(t);
      b_[lane] = static_cast<float>(v / sum), c_[lane] = static_cast<float>(w / sum);
      turns_ = sum > 0 ? turns_ | bit : turns_ & ~bit;
    }
  }

  unsigned hits_;
  unsigned turns_, front_turns_;  // counter-clockwise in the frame, and how fronts turn there
  alignas(32) float t_[lane_count], b_[lane_count], c_[lane_count];
};

}  // namespace candil
