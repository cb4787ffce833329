#include "io/placement.h"

#include <cmath>

namespace candil {

namespace {

constexpr float farthest = 1e9f;

/// Squares of smaller vectors would underflow.
bool has_length(Vec3 v) {
  const float length = glm::length(v);
  return length > 1e-15f && length < infinity;
}

bool is_framed(float width, float height) {
  constexpr float most = 1e6f;
  return width <= most * height && height <= most * width;
}

}  // namespace

bool is_finite(const Affine& transform) {
  return is_finite(transform.linear[0]) && is_finite(transform.linear[1]) && is_finite(transform.linear[2]) &&
         is_finite(transform.translation);
}

bool is_within_reach(Vec3 position) { return is_finite(position) && max_component(glm::abs(position)) <= farthest; }

bool can_be_entered(const Affine& transform) {
  if (!is_finite(transform) || !std::isnormal(glm::determinant(transform.linear))) return false;
  constexpr float most = 1e8f;
  const Affine inverted = inverse(transform);
  for (int column = 0; column < 3; ++column) {
    if (!is_finite(inverted.linear[column]) || max_component(glm::abs(inverted.linear[column])) > most) return false;
  }
  return is_finite(inverted.translation);
}

bool is_usable(const Camera& camera) {
  const Vec3 up = camera.to_world.linear[1], back = camera.to_world.linear[2];
  if (!has_length(up) || !has_length(back) || !has_length(glm::cross(glm::normalize(back), up))) return false;
  if (!is_within_reach(camera.to_world.translation)) return false;
  if (camera.kind == CameraKind::perspective) return camera.aspect == 0 || is_framed(camera.aspect, 1);
  return camera.xmag <= farthest && camera.ymag <= farthest && is_framed(camera.xmag, camera.ymag);
}

Vec3 turned(const Affine& transform, Vec3 direction) {
  const glm::dvec3 result = glm::dmat3(transform.linear) * glm::dvec3(direction);
  const double length = glm::length(result);
  return length > 0 && length < infinity ? Vec3(result / length) : direction;
}

}  // namespace candil
