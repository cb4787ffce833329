#include "tests/support/shape_samples.h"

#include <utility>

namespace candil::test {

std::vector<ShapeSample> shape_samples() {
  const Mat3 stretched = Mat3(Vec3(0.36f, 0.48f, -0.8f), Vec3(-0.8f, 0.6f, 0), Vec3(0.48f, 0.64f, 0.6f)) *
                         Mat3(Vec3(3, 0, 0), Vec3(0, 0.2f, 0), Vec3(0, 0, 1));
  const std::pair<const char*, Affine> transforms[] = {
      {"unit", Affine{}},
      {"moved", {Mat3(0.5f), Vec3(3, -2, 7)}},
      {"tiny", {Mat3(1e-4f), Vec3(2e-4f, 0, -1e-4f)}},
      {"huge", {Mat3(1e5f), Vec3(0, -1e5f, 3e4f)}},
      {"touching_origin", {Mat3(1), Vec3(0, 0, -1)}},
      {"stretched", {stretched, Vec3(-1, 2, 0.5f)}},
      {"sheared_mirrored", {Mat3(Vec3(0.5f, 0.2f, 0), Vec3(-0.4f, 2, 0.3f), Vec3(0, 0.6f, -1)), Vec3(-1, 0, 4)}},
      {"far", {Mat3(1), Vec3(3e3f, -2e3f, 5e3f)}},
  };
  const std::pair<const char*, ShapeKind> kinds[] = {
      {"sphere", ShapeKind::sphere}, {"disc", ShapeKind::disc}, {"plane", ShapeKind::plane}};
  std::vector<ShapeSample> samples;
  for (const auto& [kind_name, kind] : kinds) {
    for (const auto& [transform_name, transform] : transforms) {
      samples.push_back({std::string(kind_name) + "_" + transform_name, {"", kind, transform, 0}});
    }
  }
  return samples;
}

Scene scene_of(const Shape& shape) {
  Scene scene;
  scene.shapes = {shape};
  scene.materials.resize(1);
  scene.materials[0].is_double_sided = true;
  scene.materials[0].base_color_texture.texture = 0;  // so that texture coordinates are looked up
  return scene;
}

}  // namespace candil::test
