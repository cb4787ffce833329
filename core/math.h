/// Vector types and constants used everywhere. Right-handed, +Y up, metres and radians.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace candil {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Triangle = glm::u32vec3;  ///< Three vertex ids of a mesh.

inline constexpr float pi = std::numbers::pi_v<float>;
inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr std::uint32_t invalid_id = ~std::uint32_t{0};
/// Largest float below 1: random numbers live in [0, 1).
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

inline float sqr(float x) { return x * x; }
inline float max_component(Vec3 v) { return glm::max(v.x, glm::max(v.y, v.z)); }
inline float min_component(Vec3 v) { return glm::min(v.x, glm::min(v.y, v.z)); }
inline float length_squared(Vec3 v) { return glm::dot(v, v); }
inline bool is_black(Vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }
inline bool is_finite(Vec3 v) {
  // One add instead of three tests: a sum of finite floats that overflows is not a usable value either.
  return glm::abs(v.x) + glm::abs(v.y) + glm::abs(v.z) < infinity;
}
/// Square root of a value that rounding may have pushed below zero.
inline float safe_sqrt(float x) { return glm::sqrt(glm::max(0.0f, x)); }

}  // namespace candil
