// Morph targets, seen: weights of 0 change nothing, and a target in full is the mesh that it leads to, also on the way
// of an animation.
#include <gtest/gtest.h>

#include "core/camera.h"
#include "integrators/render.h"
#include "tests/support/gltf/animated_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// The corners of a tent: a square whose middle has the height `middle`.
std::vector<float> tent(float middle) { return {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, middle}; }

AnimatedSample tent_sample(float middle, const std::string& mesh_members) {
  AnimatedSample sample;
  const int position = sample.add_accessor(gl_float, "VEC3", 5, tent(middle));
  const int indices =
      sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 12, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4});
  const int target = sample.add_accessor<float>(gl_float, "VEC3", 5, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2});
  sample.meshes = {"{\"primitives\":[{\"material\":0,\"attributes\":{\"POSITION\":" + std::to_string(position) +
                   "},\"indices\":" + std::to_string(indices) +
                   ",\"targets\":[{\"POSITION\":" + std::to_string(target) + "}]}]" + mesh_members + "}"};
  sample.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":0}})"};
  sample.nodes = {R"({"mesh":0})"};
  return sample;
}

Image photograph(Scene scene) {
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = glm::normalize(Vec3(-1, -0.3f, -1));
  scene.punctual_lights.push_back(sun);
  const Stage stage(std::move(scene));
  RenderSettings settings;
  settings.width = 32, settings.height = 32, settings.samples_per_pixel = 16;
  return render(stage.context(), look_at(Vec3(0, -3, 3), Vec3(0), 0.8f), settings).film.mean();
}

TEST(GltfMorphImage, NoWeightIsTheBaseMesh) {
  EXPECT_EQ(photograph(load_sample(tent_sample(1, R"(,"weights":[0])")).scene).pixels,
            photograph(load_sample(tent_sample(1, "")).scene).pixels);
}

// The target raises the middle by 2: from 0 with weight 1/2, or from -1 with weight 1, it comes to 1. Flat shading
// takes its normals from the raised mesh.
TEST(GltfMorphImage, WeightsLeadToTheMeshOfTheTarget) {
  const Image expected = photograph(load_sample(tent_sample(1, "")).scene);
  EXPECT_EQ(photograph(load_sample(tent_sample(0, R"(,"weights":[0.5])")).scene).pixels, expected.pixels);
  EXPECT_EQ(photograph(load_sample(tent_sample(-1, R"(,"weights":[1])")).scene).pixels, expected.pixels);
  EXPECT_NE(photograph(load_sample(tent_sample(0, "")).scene).pixels, expected.pixels);
}

TEST(GltfMorphImage, AnimationsPassThroughIt) {
  AnimatedSample sample = tent_sample(0, "");
  sample.move_node(0, "weights", "SCALAR", {0, 4}, {0, 1});
  LoadOptions half;
  half.at = 2;
  EXPECT_EQ(photograph(load_text(sample.animated_json(), half).scene).pixels,
            photograph(load_sample(tent_sample(1, "")).scene).pixels);
}

}  // namespace
}  // namespace candil::test
