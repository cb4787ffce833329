/// Eight triangles at once: the test of core/bvh/triangle_test.h, operation by operation.
#pragma once

#include "core/bvh/lanes.h"
#include "core/bvh/triangle_test.h"

namespace candil {

struct alignas(64) TriangleBlock {
  float vertices[3][3][lane_count];  ///< Vertex, axis, triangle. Unused triangles are not a number.
  std::uint32_t id[lane_count];      ///< Of the triangle in the hierarchy; with filter_bit where hits need a filter.

  static constexpr std::uint32_t filter_bit = 0x80000000;

  Vec3 vertex(int corner, int lane) const {
    return {vertices[corner][0][lane], vertices[corner][1][lane], vertices[corner][2][lane]};
  }
};
static_assert(sizeof(TriangleBlock) == 320);

/// A RayFrame with its axes as byte offsets into TriangleBlock::vertices.
struct BlockRay {
  explicit BlockRay(const Ray& ray) : frame(ray) { x = offset(frame.x), y = offset(frame.y), z = offset(frame.z); }
  static std::uint32_t offset(int axis) { return static_cast<std::uint32_t>(axis) * sizeof(float[lane_count]); }

  RayFrame<float> frame;
  std::uint32_t x, y, z;
};

/// Where a ray crosses the triangles of a block at t in [0, t_max].
class BlockCrossings {
 public:
  BlockCrossings(const TriangleBlock& block, const BlockRay& ray, float t_max) {
    const RayFrame<float>& frame = ray.frame;
    struct Places {
      Float8 x, y, z;
    };
    const auto place = [&](int corner) -> Places {
      const char* const rows = reinterpret_cast<const char*>(block.vertices[corner]);
      const Float8 z = load8(rows + ray.z) - splat8(frame.origin[frame.z]);
      return {(load8(rows + ray.x) - splat8(frame.origin[frame.x])) - splat8(frame.shear_x) * z,
              (load8(rows + ray.y) - splat8(frame.origin[frame.y])) - splat8(frame.shear_y) * z,
              splat8(frame.inverse_z) * z};
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
    fronts_ = sign_bits(sum > 0) ^ (frame.is_front(true) ? 0 : 0xff);
    const unsigned unsure = hits_ & sign_bits(is_unsure);
    if (unsure != 0) [[unlikely]]
      cross_exactly(block, frame, t_max, unsure);
  }

  unsigned hits() const { return hits_; }  ///< Bit i: triangle i is hit. The rest is about those that are.
  float t(int lane) const { return t_[lane]; }
  Vec2 barycentric(int lane) const { return {b_[lane], c_[lane]}; }
  bool is_front_face(int lane) const { return (fronts_ >> lane & 1) != 0; }

 private:
  [[gnu::noinline]] void cross_exactly(const TriangleBlock& block, const RayFrame<float>& frame, float t_max,
                                       unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      const unsigned bit = 1U << lane;
      TriangleCrossing crossing;
      const bool is_hit = cross_places_exactly(frame, frame.place(block.vertex(0, lane)),
                                               frame.place(block.vertex(1, lane)), frame.place(block.vertex(2, lane)),
                                               t_max, crossing);
      hits_ &= is_hit ? ~0U : ~bit;
      t_[lane] = crossing.t, b_[lane] = crossing.barycentric.x, c_[lane] = crossing.barycentric.y;
      fronts_ = (fronts_ & ~bit) | (crossing.is_front_face ? bit : 0);
    }
  }

  unsigned hits_, fronts_;
  alignas(32) float t_[lane_count], b_[lane_count], c_[lane_count];
};

}  // namespace candil
