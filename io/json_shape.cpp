#include <cmath>

#include "io/json_internal.h"

namespace candil {
namespace {

/// Two unit vectors that make a right-handed frame with the normal; the first is horizontal, the second upright in
/// textures.
Mat3 frame_of_normal(Vec3 normal) {
  const bool is_horizontal_surface = std::abs(normal.x) + std::abs(normal.z) < 1e-6f;
  const Vec3 right = is_horizontal_surface ? Vec3(1, 0, 0) : glm::normalize(glm::cross(Vec3(0, 1, 0), normal));
  return {right, glm::cross(normal, right), normal};
}

void check_in_plane(const JsonNode& vector, Vec3 normal) {
  const float tolerance = 1e-3f;
  if (std::abs(glm::dot(vector.direction(), normal)) > tolerance) vector.fail("must be at right angles to the normal");
}

Affine plane_to_object(const JsonNode& plane) {
  Mat3 frame = frame_of_normal(plane["normal"].direction());
  const Vec3 normal = frame[2];
  if (const auto u = plane.find("u")) {
    check_in_plane(*u, normal);
    frame[0] = u->vec3() - glm::dot(u->vec3(), normal) * normal;
    frame[1] = glm::cross(normal, frame[0]);
  }
  if (const auto v = plane.find("v")) {
    check_in_plane(*v, normal);
    if (!plane.has("u")) v->fail("needs \"u\" beside it");
    frame[1] = v->vec3() - glm::dot(v->vec3(), normal) * normal;
    const float sine = glm::length(glm::cross(glm::normalize(frame[0]), glm::normalize(frame[1])));
    if (!(sine > 1e-4f)) v->fail("must not be parallel to \"u\"");
  }
  return {frame, plane["point"].vec3()};
}

Affine scaled(const Mat3& frame, float scale, Vec3 center) {
  return {Mat3(scale * frame[0], scale * frame[1], scale * frame[2]), center};
}

}  // namespace

void add_shape(const JsonNode& object, JsonMaterials& materials, Scene& scene) {
  Shape shape;
  shape.name = object_name(object);
  shape.material = materials.of_object(object);
  const std::string type = object["type"].text();
  Affine to_object;
  if (type == "sphere") {
    shape.kind = ShapeKind::sphere;
    to_object = scaled(Mat3(1), object["radius"].number(), object["center"].vec3());
  } else if (type == "disc") {
    shape.kind = ShapeKind::disc;
    to_object =
        scaled(frame_of_normal(object["normal"].direction()), object["radius"].number(), object["center"].vec3());
  } else {
    shape.kind = ShapeKind::plane;
    to_object = plane_to_object(object);
  }
  // Of a plane, only where it begins and its units count.
  const Bounds bounds{Vec3(-1), Vec3(1)};
  for (const Affine& placement : read_placements(object)) {
    shape.to_world = placement * to_object;
    check_reach(object, bounds, shape.to_world);
    scene.shapes.push_back(shape);
  }
}

}  // namespace candil
