#include "io/json_internal.h"

namespace candil {
namespace {

/// The camera's axes: x to the right, y up, -z to what it looks at.
Mat3 camera_axes(const JsonNode& source, Vec3 from, Vec3 at) {
  if (!(glm::length(at - from) > 0)) source["look_at"].fail("must differ from \"look_from\"");
  const Vec3 back = glm::normalize(from - at);
  const auto up = source.find("up");
  Vec3 upright = up ? up->direction() : Vec3(0, 1, 0);
  if (glm::length(glm::cross(upright, back)) < 1e-4f) {
    if (up) up->fail("must not be parallel to the viewing direction");
    upright = Vec3(0, 0, -1);  // looks along +Y or -Y
  }
  const Vec3 right = glm::normalize(glm::cross(upright, back));
  return {right, glm::cross(back, right), back};
}

float read_focus(const JsonNode& source, const Camera& camera, float distance_to_target) {
  const auto at = source.find("focus_at");
  if (!at) return source.number("focus_distance", distance_to_target);
  if (source.has("focus_distance")) at->fail("must not stand beside \"focus_distance\"");
  const float distance = glm::dot(at->vec3() - camera.to_world.translation, -camera.to_world.linear[2]);
  if (!(distance > 0)) at->fail("must lie in front of the camera");
  return distance;
}

Camera read_camera(const JsonNode& source) {
  const Vec3 from = source["look_from"].vec3(), at = source["look_at"].vec3();
  Camera camera;
  camera.name = object_name(source);
  camera.to_world = {camera_axes(source, from, at), from};
  camera.yfov = source.radians("fov", 45);
  if (const auto height = source.find("height")) {
    if (source.has("fov")) height->fail("must not stand beside \"fov\"");
    camera.kind = CameraKind::orthographic;
    // The width follows from the picture: a wide picture shows more at its sides.
    camera.xmag = camera.ymag = 0.5f * height->number();
  }
  camera.lens_radius = source.number("lens_radius", 0);
  camera.focus_distance = read_focus(source, camera, glm::length(at - from));
  if (const auto blades = source.find("blades")) camera.lens_blades = static_cast<int>(blades->integer());
  camera.lens_rotation = source.radians("blade_rotation", 0);
  return camera;
}

}  // namespace

void add_cameras(const std::vector<JsonFile>& files, Scene& scene) {
  for (auto file = files.rbegin(); file != files.rend() && scene.cameras.empty(); ++file) {
    const JsonNode root(*file);
    if (const auto camera = root.find("camera")) scene.cameras.push_back(read_camera(*camera));
    const auto others = root.find("cameras");
    for (std::size_t i = 0; others && i < others->size(); ++i) scene.cameras.push_back(read_camera((*others)[i]));
  }
}

}  // namespace candil
