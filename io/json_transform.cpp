#include <cmath>

#include "io/json_internal.h"
#include "io/placement.h"

namespace candil {
namespace {

/// Rodrigues' formula; counter-clockwise for who looks against the axis (unit length).
Mat3 rotation(Vec3 axis, float angle) {
  const float sine = std::sin(angle), cosine = std::cos(angle);
  const Mat3 cross(0, axis.z, -axis.y, -axis.z, 0, axis.x, axis.y, -axis.x, 0);
  return cosine * Mat3(1) + sine * cross + (1 - cosine) * glm::outerProduct(axis, axis);
}

Mat3 diagonal(Vec3 v) { return {v.x, 0, 0, 0, v.y, 0, 0, 0, v.z}; }

Affine read_matrix(const JsonNode& rows) {
  Affine matrix;
  for (int row = 0; row < 3; ++row) {
    const JsonNode values = rows[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column)
      matrix.linear[column][row] = values[static_cast<std::size_t>(column)].number();
    matrix.translation[row] = values[3].number();
  }
  return matrix;
}

Affine read_step(const JsonNode& step) {
  const std::string kind = step.keys().front();
  const JsonNode value = step[kind];
  if (kind == "translate") return {Mat3(1), value.vec3()};
  if (kind == "scale") return {diagonal(value.color()), Vec3(0)};
  if (kind == "matrix") return read_matrix(value);
  if (kind == "rotate") return {rotation(value["axis"].direction(), value.radians("angle", 0)), Vec3(0)};
  const Vec3 axis(kind == "rotate_x", kind == "rotate_y", kind == "rotate_z");
  return {rotation(axis, glm::radians(value.number())), Vec3(0)};
}

}  // namespace

Affine read_transform(const JsonNode& steps) {
  Affine transform;
  for (std::size_t i = 0; i < steps.size(); ++i) transform = read_step(steps[i]) * transform;
  return transform;
}

std::vector<Affine> read_placements(const JsonNode& object) {
  Affine own;
  if (const auto transform = object.find("transform")) {
    own = read_transform(*transform);
    if (!can_be_entered(own)) transform->fail("must be invertible: it scales to nothing or beyond all numbers");
  }
  const auto instances = object.find("instances");
  if (!instances) return {own};
  std::vector<Affine> placements;
  for (std::size_t i = 0; i < instances->size(); ++i) {
    const JsonNode instance = (*instances)[i];
    placements.push_back(read_transform(instance) * own);
    if (!can_be_entered(placements.back()))
      instance.fail("must be invertible: it scales to nothing or beyond all numbers");
  }
  return placements;
}

void check_reach(const JsonNode& object, const Bounds& bounds, const Affine& to_world) {
  for (int i = 0; i < 8 && !bounds.is_empty(); ++i) {
    if (!is_within_reach(to_world.point(bounds.corner(i)))) object.fail("reaches farther than 1e9 m from the origin");
  }
}

}  // namespace candil
