/// What the tests of the bench render.
#pragma once

#include "core/camera.h"
#include "tests/support/scene_builder.h"

namespace candil::test {

/// A floor and a wall that fill the picture, a lamp, a ball of triangles, a sphere, and an object that is there twice.
inline Scene lit_room() {
  SceneBuilder builder;
  const std::uint32_t white = builder.add_diffuse(Vec3(0.7f));
  builder.add_quad({-6, -1, 4}, {12, 0, 0}, {0, 0, -6}, white);
  builder.add_quad({-6, -1, -2}, {12, 0, 0}, {0, 8, 0}, white);
  builder.add_quad({-0.5f, 1.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, builder.add_diffuse(Vec3(0), Vec3(10)));
  builder.add_sphere({0.7f, -0.4f, 0}, 0.6f, white, 24);
  builder.add_shape(ShapeKind::sphere, {Mat3(0.5f), {-0.7f, -0.5f, 0}}, white);
  builder.add_cube(Vec3(0), 0.2f, white, false);
  Scene& scene = builder.scene;
  Instance& cube = scene.instances.back();
  cube.is_world_space = false;
  cube.to_world.translation = {0, 0.6f, 0.5f};
  Instance other = cube;
  other.to_world.translation = {-1, 1, 0};
  scene.instances.push_back(other);
  return std::move(scene);
}

inline Camera room_camera() { return look_at({0, 0.2f, 5}, {0, 0, 0}, 0.8f); }

inline RenderSettings small_settings() {
  RenderSettings settings;
  settings.width = 40, settings.height = 24;  // tiles at the edges are not whole
  settings.samples_per_pixel = 3;
  settings.threads = 1;
  return settings;
}

}  // namespace candil::test
