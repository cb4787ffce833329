/// An orthonormal frame around a normal: local z is the normal.
#pragma once

#include <cmath>

#include "core/simd.h"

namespace candil {

struct Frame {
  Vec3 tangent, bitangent, normal;

  /// From a unit normal alone (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1)).
  explicit Frame(Vec3 n) : normal(n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1 / (sign + n.z);
    const float b = n.x * n.y * a;
    tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }

  /// With local x along `direction`, as far as the normal lets it; any if it lets it not at all.
  Frame(Vec3 n, Vec3 direction) : Frame(n) {
    const Vec3 projected = direction - glm::dot(direction, n) * n;
    const float squared = glm::dot(projected, projected);
    if (!(squared > 1e-12f)) return;
    tangent = projected / glm::sqrt(squared);
    bitangent = glm::cross(n, tangent);
  }

  Vec3 to_local(Vec3 v) const { return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)}; }
  Vec3 to_world(Vec3 v) const {
    return to_vec3(v.x * to_lanes(tangent) + v.y * to_lanes(bitangent) + v.z * to_lanes(normal));
  }
};

}  // namespace candil
