// Skins, seen: a mesh on joints in their bind pose looks as without them, and a moved joint moves what hangs on it as a
// node would.
#include <gtest/gtest.h>

#include "core/camera.h"
#include "integrators/render.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// A strip of three squares from x = 0 to 3, folded along y so that shading shows its normals. Joint 0 (node 1) holds
/// its left, joint 1 (node 2) its right edge. `node` shows it.
GltfSample strip(const std::string& node, const std::string& second_joint) {
  GltfSample sample;
  std::vector<float> positions, weights;
  std::vector<std::uint8_t> joints;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 2; ++row) {
      const float right = column < 2 ? 0.0f : 1.0f;
      positions.insert(positions.end(), {float(column), float(row), column % 2 == 0 ? 0.0f : 0.5f});
      weights.insert(weights.end(), {1 - right, right, 0, 0});
      joints.insert(joints.end(), {0, 1, 0, 0});
    }
  }
  const int position = sample.add_accessor(gl_float, "VEC3", 8, positions);
  const int weight = sample.add_accessor(gl_float, "VEC4", 8, weights);
  const int joint = sample.add_accessor(gl_unsigned_byte, "VEC4", 8, joints);
  const int matrices = sample.add_accessor<float>(
      gl_float, "MAT4", 2,
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1});
  sample.meshes = {
      "{\"primitives\":[{\"mode\":5,\"material\":0,\"attributes\":{\"POSITION\":" + std::to_string(position) +
      ",\"JOINTS_0\":" + std::to_string(joint) + ",\"WEIGHTS_0\":" + std::to_string(weight) + "}}]}"};
  sample.materials = {R"({"doubleSided":true,"pbrMetallicRoughness":{"metallicFactor":0}})"};
  sample.nodes = {node, R"({"children":[2]})", second_joint};
  sample.root = ",\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":" + std::to_string(matrices) + "}]";
  return sample;
}

Image photograph(Scene scene) {
  scene.environment.tint = Vec3(0.2f);
  PunctualLight sun;
  sun.kind = PunctualKind::directional;
  sun.direction = glm::normalize(Vec3(-1, -1, -2));
  scene.punctual_lights.push_back(sun);
  const Stage stage(std::move(scene));
  RenderSettings settings;
  settings.width = 48, settings.height = 32, settings.samples_per_pixel = 16;
  return render(stage.context(), look_at(Vec3(1.5f, 0.5f, 6), Vec3(1.5f, 0.5f, 0), 0.8f), settings).film.mean();
}

const std::string bind_pose = R"({"translation":[2,0,0]})";

TEST(GltfSkinImage, RestPoseEqualsTheUnskinnedMesh) {
  const Image unskinned = photograph(load_sample(strip(R"({"mesh":0})", bind_pose)).scene);
  const Image skinned =
      photograph(load_sample(strip(R"({"mesh":0,"skin":0,"translation":[0,40,0]})", bind_pose)).scene);
  EXPECT_EQ(skinned.pixels, unskinned.pixels);
  EXPECT_GT(*std::max_element(unskinned.pixels.begin(), unskinned.pixels.end()), 0.3f) << "something is seen";
}

// Joint 1 rises by 1: the right part is lifted, the left stays. Outside of the square between them each half of the
// picture is that of the whole strip moved by a node.
TEST(GltfSkinImage, JointsMoveWhatHangsOnThem) {
  const Image low = photograph(load_sample(strip(R"({"mesh":0})", bind_pose)).scene);
  const Image high = photograph(load_sample(strip(R"({"mesh":0,"translation":[0,1,0]})", bind_pose)).scene);
  const Image bent = photograph(load_sample(strip(R"({"mesh":0,"skin":0})", R"({"translation":[2,1,0]})")).scene);
  // 32 pixels see 2 * 6 tan(0.4) = 5.07 m at z = 0, so that 1 m is at least 6.3 pixels: columns 1.5 m from the middle
  // of the strip are 9.5 pixels from the middle of the picture. The filter reaches 1.5 pixels, bounced light is small.
  float left_error = 0, right_error = 0, left_change = 0, right_change = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 48; ++x) {
      const std::size_t at = (std::size_t(y) * 48 + std::size_t(x)) * std::size_t(bent.channels);
      const float to_low = std::abs(bent.pixels[at] - low.pixels[at]);
      const float to_high = std::abs(bent.pixels[at] - high.pixels[at]);
      if (x < 18) left_error += to_low, left_change += to_high;
      if (x >= 30) right_error += to_high, right_change += to_low;
    }
  }
  EXPECT_LT(left_error, 0.05f * left_change);
  EXPECT_LT(right_error, 0.05f * right_change);
  EXPECT_GT(left_change, 1);
  EXPECT_GT(right_change, 1);
}

}  // namespace
}  // namespace candil::test
