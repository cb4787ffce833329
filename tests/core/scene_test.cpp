#include "core/scene.h"

#include <gtest/gtest.h>

#include <array>

#include "core/surface.h"
#include "tests/support/expect_near.h"

namespace candil {
namespace {

using test::expect_near;

/// A bent strip of two triangles with every attribute.
Mesh strip() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0.2f}, {1, 1, 0.5f}, {0, 1, 0.1f}};
  mesh.normals = {glm::normalize(Vec3(-0.2f, 0, 1)), glm::normalize(Vec3(0, -0.3f, 1)),
                  glm::normalize(Vec3(0.1f, -0.4f, 1)), glm::normalize(Vec3(-0.4f, 0.1f, 1))};
  for (const Vec3 n : mesh.normals) {
    mesh.tangents.emplace_back(glm::normalize(Vec3(1, 0, 0) - n.x * n), 1);
  }
  mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.colors = {Vec4(1), Vec4(0.5f), Vec4(0, 1, 0, 1), Vec4(0, 0, 1, 0.2f)};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Scene scene_of(std::initializer_list<Affine> transforms) {
  Scene scene;
  scene.meshes = {strip()};
  scene.objects = {{"", 0, 1}};
  scene.materials.resize(1);
  for (const Affine& transform : transforms) scene.instances.push_back({"", 0, transform, false});
  return scene;
}

const std::array transforms = {
    Affine{Mat3(1), Vec3(3, 4, 5)},
    Affine{Mat3(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)), Vec3(1, 0, 0)},
    Affine{Mat3(Vec3(2, 0, 0), Vec3(0, 0.3f, 0), Vec3(0, 0, 1)), Vec3(0)},
    Affine{Mat3(Vec3(0.5f, 0.2f, 0), Vec3(-0.4f, 2, 0.3f), Vec3(0, 0.6f, -1)), Vec3(-1, 0, 4)},
    Affine{Mat3(-1), Vec3(0)},
};

/// The point of a triangle that is the given mix of vertices, whatever order the triangle lists them in.
SurfacePoint point_of(const Scene& scene, std::uint32_t triangle, std::array<float, 4> vertex_weights) {
  const Triangle t = scene.meshes[0].triangles[triangle];
  Hit hit;
  hit.triangle = triangle;
  hit.barycentric = {vertex_weights[t.y], vertex_weights[t.z]};
  return make_surface_point(scene, hit);
}

// Baking moves work from rays to loading and must not be seen: same points, same frames, same front, at vertices as
// inside of triangles.
TEST(BakeSingleInstances, KeepsEverySurfacePoint) {
  for (const Affine& transform : transforms) {
    const Scene plain = scene_of({transform});
    Scene baked = plain;
    bake_single_instances(baked);
    ASSERT_TRUE(baked.instances[0].is_world_space);
    EXPECT_EQ(baked.instances[0].to_world.linear, Mat3(1));
    for (const std::array<float, 4>& weights :
         {std::array{1.0f, 0.0f, 0.0f, 0.0f}, std::array{0.0f, 0.0f, 1.0f, 0.0f}, std::array{0.5f, 0.0f, 0.5f, 0.0f}}) {
      for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
        const SurfacePoint a = point_of(plain, triangle, weights), b = point_of(baked, triangle, weights);
        expect_near(a.position, b.position, 1e-5f, "position");
        expect_near(a.normal_geometric, b.normal_geometric, 1e-5f, "flat normal");
        EXPECT_EQ(a.uv[0], b.uv[0]);
        EXPECT_EQ(a.color, b.color);
        EXPECT_EQ(a.tangent.w, b.tangent.w);
      }
    }
    // At vertices normals and tangents are exact. Between them, transforming first and interpolating first differ where
    // lengths change: both are smooth, neither is the right one.
    for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
      std::array<float, 4> weights{};
      weights[vertex] = 1;
      const SurfacePoint a = point_of(plain, 0, weights), b = point_of(baked, 0, weights);
      expect_near(a.normal, b.normal, 1e-5f, "normal");
      expect_near(glm::normalize(Vec3(a.tangent)), glm::normalize(Vec3(b.tangent)), 1e-5f, "tangent");
    }
  }
}

TEST(BakeSingleInstances, LeavesSharedObjectsAlone) {
  Scene scene = scene_of({transforms[0], transforms[1]});
  const std::vector<Vec3> before = scene.meshes[0].positions;
  bake_single_instances(scene);
  EXPECT_EQ(scene.meshes[0].positions, before);
  EXPECT_FALSE(scene.instances[0].is_world_space);
  EXPECT_EQ(scene.instances[1].to_world.linear, transforms[1].linear);
}

TEST(BakeSingleInstances, TwiceIsOnce) {
  Scene once = scene_of({transforms[3]});
  bake_single_instances(once);
  Scene twice = once;
  bake_single_instances(twice);
  EXPECT_EQ(twice.meshes[0].positions, once.meshes[0].positions);
  EXPECT_EQ(twice.meshes[0].triangles, once.meshes[0].triangles);
}

// A scene that looks the same has the same box, the same number of triangles.
TEST(BakeSingleInstances, KeepsBoundsAndCounts) {
  for (const Affine& transform : transforms) {
    const Scene plain = scene_of({transform});
    Scene baked = plain;
    bake_single_instances(baked);
    expect_near(scene_bounds(plain).low, scene_bounds(baked).low, 1e-6f, "low");
    expect_near(scene_bounds(plain).high, scene_bounds(baked).high, 1e-6f, "high");
    EXPECT_EQ(instanced_triangle_count(plain), instanced_triangle_count(baked));
  }
}

// Corners 0, 0, 0 and 1, 1, 0.5; moved by (3, 4, 5), and turned through the origin.
TEST(SceneBounds, HoldAllInstances) {
  const Bounds moved = scene_bounds(scene_of({transforms[0]}));
  expect_near(moved.low, Vec3(3, 4, 5), 1e-6f, "low");
  expect_near(moved.high, Vec3(4, 5, 5.5f), 1e-6f, "high");
  const Bounds both = scene_bounds(scene_of({transforms[0], transforms[4]}));
  expect_near(both.low, Vec3(-1, -1, -0.5f), 1e-6f, "low");
  expect_near(both.high, Vec3(4, 5, 5.5f), 1e-6f, "high");
  expect_near(both.center(), Vec3(1.5f, 2, 2.5f), 1e-6f, "center");
  EXPECT_NEAR(both.radius(), 0.5f * glm::length(Vec3(5, 6, 6)), 1e-5f);
}

TEST(SceneBounds, AreEmptyWithoutGeometry) {
  EXPECT_TRUE(scene_bounds(Scene{}).is_empty());
  EXPECT_EQ(scene_bounds(Scene{}).radius(), 0);
  Scene unused = scene_of({});
  EXPECT_TRUE(scene_bounds(unused).is_empty());
}

TEST(InstancedTriangleCount, CountsEveryUse) {
  EXPECT_EQ(instanced_triangle_count(scene_of({transforms[0], transforms[1], transforms[2]})), 6u);
  EXPECT_EQ(instanced_triangle_count(Scene{}), 0u);
}

TEST(HasLight, RuleOfEmission) {
  Scene scene = scene_of({Affine{}});
  EXPECT_FALSE(has_light(scene));
  scene.materials[0].emission = Vec3(1);  // as far as core glTF goes: it glows, but lights nothing
  EXPECT_FALSE(has_light(scene));
  scene.materials[0].emission = Vec3(0, 0, 1.5f);
  EXPECT_TRUE(has_light(scene));
  scene.instances.clear();  // a material that nothing in the scene has
  EXPECT_FALSE(has_light(scene));
}

TEST(HasLight, UnlitIsNoLight) {
  Scene scene = scene_of({Affine{}});
  scene.materials[0].is_unlit = true;
  EXPECT_FALSE(has_light(scene));
}

TEST(HasLight, PunctualAndEnvironmentAreLights) {
  Scene lamp;
  lamp.punctual_lights.resize(1);
  EXPECT_TRUE(has_light(lamp));
  Scene sky;
  sky.environment.tint = Vec3(0, 0.1f, 0);
  EXPECT_TRUE(has_light(sky));
  EXPECT_FALSE(has_light(Scene{}));
}

}  // namespace
}  // namespace candil
