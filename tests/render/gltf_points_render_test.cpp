// Points and lines with --point-radius, seen by rays: silhouettes have the size of spheres and cylinders, whatever the
// transform of the node.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene.h"
#include "core/surface.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

constexpr float radius = 0.25f;

LoadedScene load_thick(const GltfSample& sample) {
  LoadOptions options;
  options.point_radius = radius;
  return load_sample(sample, options);
}

/// Turned, mirrored and stretched.
constexpr const char* stretched = R"("translation":[0.1,0.2,0.3],"rotation":[0.3,0,0,0.9539392],"scale":[-2,0.5,3])";

GltfSample sample_of(int mode, const std::vector<float>& positions, const std::string& node) {
  GltfSample sample;
  sample.add_accessor(gl_float, "VEC3", positions.size() / 3, positions);
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0},"mode":)" + std::to_string(mode) + "}]}"};
  sample.nodes = {"{\"mesh\":0" + (node.empty() ? "" : "," + node) + "}"};
  return sample;
}

/// That of a point, or of a line.
Vec3 middle_of(const Scene& scene) { return scene_bounds(scene).center(); }

/// Area in which parallel rays of a direction hit the scene, over a square of `width` around `center`, its sides
/// along `up` where that is perpendicular. They must all
/// come upon fronts.
float silhouette(const Stage& stage, Vec3 center, Vec3 direction, Vec3 up, float width) {
  constexpr int resolution = 256;
  const Vec3 u = glm::normalize(glm::cross(up, direction)), v = glm::cross(direction, u);
  int hits = 0;
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const auto offset = [&](int i) {
        return width * ((static_cast<float>(i) + 0.5f) / static_cast<float>(resolution) - 0.5f);
      };
      const Ray ray{center + offset(x) * u + offset(y) * v - 10.0f * direction, direction};
      const auto hit = stage.accelerator().intersect(ray);
      if (!hit) continue;
      ++hits;
      const SurfacePoint point = make_surface_point(stage.scene(), *hit);
      EXPECT_LT(glm::dot(point.normal_geometric, direction), 0) << "the back of a triangle";
      EXPECT_GT(glm::dot(point.normal_geometric, point.normal), 0.9f);
    }
  }
  return width * width * static_cast<float>(hits) / static_cast<float>(resolution * resolution);
}

const std::vector<Vec3> directions = {{1, 0, 0},
                                      {0, -1, 0},
                                      {0, 0, 1},
                                      glm::normalize(Vec3(1, 2, -3)),
                                      glm::normalize(Vec3(-2, 1, 0.3f)),
                                      glm::normalize(Vec3(0.2f, 0.3f, 1))};

// 1280 triangles whose mean silhouette is pi r^2. Their corners are 0.24 % beyond r and their planes at least 0.9978 r
// away from the middle: any single silhouette is within 0.5 % of it. 256^2 rays over (2.4 r)^2 add an error of the
// order of (cells of the outline)^(1/2) / (cells inside) = 0.1 %.
TEST(GltfPoints, SilhouettesHaveTheAreaOfSpheres) {
  for (const char* node : {"", stretched}) {
    const LoadedScene loaded = load_thick(sample_of(0, {1, 2, 3}, node));
    EXPECT_TRUE(loaded.warnings.empty());
    const Stage stage(loaded.scene);
    float mean = 0;
    for (const Vec3 direction : directions) {
      const float area = silhouette(stage, middle_of(loaded.scene), direction, Vec3(0.3f, 0.5f, 0.8f), 2.4f * radius);
      EXPECT_NEAR(area / (pi * radius * radius), 1, 0.007f) << node;
      mean += area / static_cast<float>(directions.size());
    }
    EXPECT_NEAR(mean / (pi * radius * radius), 1, 0.004f) << node;
  }
}

// The width of a polygon of 16 sides with perimeter 2 pi r lies between those of its two circles, 0.987 and 1.0065
// times 2 r. The square of 2.4 r around the middle of the line is far from its ends.
TEST(GltfPoints, LinesHaveTheWidthOfTheirDiameter) {
  for (const char* node : {"", stretched}) {
    const LoadedScene loaded = load_thick(sample_of(1, {1, 2, 3, 4, 8, 4}, node));
    // The bake has moved the mesh to the world; the tube's first vertices follow two balls of 642.
    const Mesh& mesh = loaded.scene.meshes.at(0);
    ASSERT_EQ(mesh.positions.size(), 2u * 642 + 32);
    const Stage stage(loaded.scene);
    const Vec3 middle = middle_of(loaded.scene);
    const Vec3 along = glm::normalize(mesh.positions[1285] - mesh.positions[1284]);
    for (const Vec3 any : directions) {
      const Vec3 across = glm::normalize(glm::cross(along, any));
      const float width = 2.4f * radius;
      const float area = silhouette(stage, middle, across, along, width);
      EXPECT_GT(area / (width * 2 * radius), 0.985f) << node;
      EXPECT_LT(area / (width * 2 * radius), 1.009f) << node;
    }
  }
}

// A closed square of edges of length 1, from above: all within r of its outline. Outside that is 4 r and the four
// quarters of a disc, inside 4 r less the four corners that two edges count, r^2 each.
TEST(GltfPoints, LoopsCloseWithRoundJoints) {
  const Stage stage(load_thick(sample_of(2, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "")).scene);
  const float expected = 8 * radius + pi * radius * radius - 4 * radius * radius;
  EXPECT_NEAR(silhouette(stage, Vec3(0.5f, 0.5f, 0), Vec3(0, 0, -1), Vec3(0, 1, 0), 2) / expected, 1, 0.012f);
}

TEST(GltfPoints, ColoursAndUvsAreThoseOfTheEnds) {
  GltfSample sample = sample_of(3, {0, 0, 0, 4, 0, 0, 4, 4, 0}, "");
  sample.add_accessor<float>(gl_float, "VEC3", 3, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  sample.add_accessor<float>(gl_float, "VEC2", 3, {0, 0, 0.5f, 0, 1, 1});
  sample.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":0.5}})"};
  sample.meshes = {
      R"({"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1,"TEXCOORD_0":2},"mode":3,"material":0}]})"};
  const LoadedScene loaded = load_thick(sample);
  EXPECT_EQ(loaded.thin.lines, 2u);
  const Scene& scene = loaded.scene;
  EXPECT_EQ(scene.materials.at(scene.meshes.at(0).material).metallic, 0.5f);
  const Stage stage(scene);
  // Down upon the first tube, a quarter of its length from its first end, and upon the ball at the last.
  const auto look_down = [&](Vec3 at) {
    return stage.accelerator().intersect(Ray{at + Vec3(0, 0, 5), Vec3(0, 0, -1)}).value();
  };
  const Hit on_tube = look_down(Vec3(1, 0.01f, 0)), on_ball = look_down(Vec3(4.01f, 4.11f, 0));
  EXPECT_LT(glm::distance(Vec3(make_surface_point(scene, on_tube).color), Vec3(0.75f, 0.25f, 0)), 1e-3f);
  EXPECT_LT(glm::distance(first_texture_coordinates(scene, on_tube), Vec2(0.125f, 0)), 1e-3f);
  EXPECT_LT(glm::distance(Vec3(make_surface_point(scene, on_ball).color), Vec3(0, 0, 1)), 1e-3f);
  EXPECT_LT(glm::distance(first_texture_coordinates(scene, on_ball), Vec2(1, 1)), 1e-3f);
}

// Only nodes that turn or scale a mesh otherwise need another one.
TEST(GltfPoints, NodesOfOneScaleShareTheirGeometry) {
  GltfSample sample = sample_of(0, {0, 0, 0, 1, 0, 0}, "");
  sample.nodes.push_back(R"({"mesh":0,"translation":[0,3,0]})");
  EXPECT_EQ(load_thick(sample).scene.meshes.size(), 1u);
  sample.nodes.push_back(R"({"mesh":0,"scale":[2,2,2]})");
  const Scene scene = load_thick(sample).scene;
  EXPECT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.instances.size(), 3u);
}

}  // namespace
}  // namespace candil::test
