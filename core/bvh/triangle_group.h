/// core/bvh/triangle_test.h for up to four triangles at once.
///
/// A group of n triangles is 9 n floats: of each vertex a, b, c, and of each axis, the coordinates of all n. Nothing is
/// padded: of the four that are loaded, those after the n-th are ignored. The last group of an array must be followed
/// by `group_padding` floats.
#pragma once

#include <bit>

#if defined(__SSE__)
#include <immintrin.h>
#endif

#include "core/bvh/triangle_test.h"
#include "core/simd.h"

namespace candil {

inline constexpr std::uint32_t max_group_size = 4;
inline constexpr std::size_t group_padding = 3;

/// Writes triangle `lane` of a group of `count`.
inline void set_in_group(float* group, std::uint32_t count, std::uint32_t lane, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 vertices[3] = {a, b, c};
  for (std::uint32_t i = 0; i < 9; ++i) group[i * count + lane] = vertices[i / 3][static_cast<int>(i % 3)];
}

/// The frame of a ray, four times.
class GroupRay {
 public:
  explicit GroupRay(const Ray& ray)
      : frame_(ray),
        origin_{splat(frame_.origin[frame_.x]), splat(frame_.origin[frame_.y]), splat(frame_.origin[frame_.z])},
        shear_x_(splat(frame_.shear_x)),
        shear_y_(splat(frame_.shear_y)),
        inverse_z_(splat(frame_.inverse_z)) {}

  /// Calls `visit(lane, crossing)` for the triangles of the group that are crossed at t in [0, t_max].
  template <typename Visit>
  void cross(const float* group, std::uint32_t count, float t_max, const Visit& visit) const {
    const Places a = place(group, count), b = place(group + 3 * count, count), c = place(group + 6 * count, count);
    const Float4 u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
    const Mask is_outside = ((u < 0) | (v < 0) | (w < 0)) & ((u > 0) | (v > 0) | (w > 0));
    unsigned candidates = ~sign_bits(is_outside) & ((1U << count) - 1);
    if (candidates == 0) return;
    const Mask is_sure = (u * v > 0) & (u * w > 0);
    const Float4 t_low = minimum(minimum(a.z, b.z), c.z), t_high = maximum(maximum(a.z, b.z), c.z);
    candidates &= ~sign_bits((t_low > t_max) | (t_high < 0));
    for (; candidates != 0; candidates &= candidates - 1) {
      const int lane = std::countr_zero(candidates);
      const glm::dvec3 places[3] = {a[lane], b[lane], c[lane]};
      bool is_counter_clockwise = u[lane] > 0;
      if (!is_sure[lane]) {
        const EdgeFunctions edges(places[0], places[1], places[2]);
        if (!edges.is_passed()) continue;
        is_counter_clockwise = edges.sum() > 0;
      }
      const float* const first = group + lane;
      const auto vertex = [&](std::uint32_t i) {
        return Vec3(first[3 * i * count], first[(3 * i + 1) * count], first[(3 * i + 2) * count]);
      };
      const PassedTriangle triangle{
          {vertex(0), vertex(1), vertex(2)}, {places[0], places[1], places[2]}, is_counter_clockwise};
      TriangleCrossing crossing;
      if (locate_crossing(frame_, triangle, t_max, crossing)) visit(static_cast<std::uint32_t>(lane), crossing);
    }
  }

 private:
  using Mask = std::int32_t __attribute__((vector_size(16)));

  struct Places {
    Float4 x, y, z;
    glm::dvec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
  };

  static Float4 load(const float* p) {
    Float4 value;
    __builtin_memcpy(&value, p, sizeof(value));
    return value;
  }
  static unsigned sign_bits(Mask mask) {
#if defined(__SSE__)
    return static_cast<unsigned>(_mm_movemask_ps(__m128(mask)));
#else
    return (mask[0] & 1U) | (mask[1] & 2U) | (mask[2] & 4U) | (mask[3] & 8U);
#endif
  }
  Places place(const float* vertex, std::uint32_t count) const {
    const Float4 x = load(vertex + frame_.x * count) - origin_[0], y = load(vertex + frame_.y * count) - origin_[1],
                 z = load(vertex + frame_.z * count) - origin_[2];
    return {x - shear_x_ * z, y - shear_y_ * z, inverse_z_ * z};
  }

  RayFrame<float> frame_;
  Float4 origin_[3];  // in the order of the frame's axes
  Float4 shear_x_, shear_y_, inverse_z_;
};

}  // namespace candil
