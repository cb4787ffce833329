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
    const Float4 sum = u + v + w, scale = 1 / sum, t = scale * u * a.z + scale * v * b.z + scale * w * c.z;
    const Mask is_sure = (u * v != 0) & (w != 0) & (absolute(sum) < infinity);
    const Mask is_missed = is_sure & ~((t >= 0) & (t <= t_max));
    candidates &= ~sign_bits(is_missed);
    for (; candidates != 0; candidates &= candidates - 1) {
      const int lane = std::countr_zero(candidates);
      TriangleCrossing crossing{
          t[lane], {scale[lane] * v[lane], scale[lane] * w[lane]}, frame_.is_front(sum[lane] > 0)};
      if (!is_sure[lane] && !cross_places_exactly(frame_, a[lane], b[lane], c[lane], t_max, crossing)) continue;
      visit(static_cast<std::uint32_t>(lane), crossing);
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
