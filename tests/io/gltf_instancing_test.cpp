// EXT_mesh_gpu_instancing: as if the node had a child with the mesh for each instance.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

constexpr const char* parent = R"({"translation":[1,2,3],"rotation":[0,0.6,0,0.8],"scale":[2,1,3])";

const std::vector<float> translations = {0, 0, 0, 5, 0, 1, -2, 4, 0.5f};
const std::vector<float> rotations = {0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0, -0.8f, 0.6f};
const std::vector<float> scales = {1, 1, 1, 0.5f, 2, -1, 3, 3, 3};

std::string numbers(const std::vector<float>& values, std::size_t element, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ",") + std::to_string(values[element * count + i]);
  return text + "]";
}

/// Node 0, the parent, shows the triangle; accessors 1 to 3 are translations, rotations and scales.
GltfSample instanced(const std::string& attributes) {
  GltfSample sample;
  sample.add_triangle();
  sample.root = R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"],"extensionsRequired":["EXT_mesh_gpu_instancing"])";
  sample.add_accessor(gl_float, "VEC3", 3, translations);
  sample.add_accessor(gl_float, "VEC4", 3, rotations);
  sample.add_accessor(gl_float, "VEC3", 3, scales);
  sample.nodes[0] = std::string(parent) + R"(,"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" +
                    attributes + "}}}}";
  return sample;
}

void expect_near(const Affine& a, const Affine& b) {
  for (int c = 0; c < 3; ++c) EXPECT_LT(glm::distance(a.linear[c], b.linear[c]), 1e-5f);
  EXPECT_LT(glm::distance(a.translation, b.translation), 1e-5f);
}

TEST(GltfInstancing, EqualsDuplicated) {
  GltfSample duplicated;
  duplicated.add_triangle();
  duplicated.nodes[0] = std::string(parent) + R"(,"children":[1,2,3]})";
  for (std::size_t i = 0; i < 3; ++i) {
    duplicated.nodes.push_back(R"({"mesh":0,"translation":)" + numbers(translations, i, 3) + R"(,"rotation":)" +
                               numbers(rotations, i, 4) + R"(,"scale":)" + numbers(scales, i, 3) + "}");
  }
  const LoadedScene copies = load_sample(duplicated);
  const LoadedScene instances = load_sample(instanced(R"("TRANSLATION":1,"ROTATION":2,"SCALE":3,"_ID":1)"));
  EXPECT_TRUE(instances.warnings.empty());
  EXPECT_EQ(instances.scene.meshes.size(), 1u) << "instances share their mesh";
  ASSERT_EQ(instances.scene.instances.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(instances.scene.instances[i].to_world, copies.scene.instances.at(i).to_world);
  }
}

TEST(GltfInstancing, WhatIsLeftOutIsTheIdentity) {
  const Scene scene = load_sample(instanced(R"("TRANSLATION":1)")).scene;
  ASSERT_EQ(scene.instances.size(), 3u);
  const Affine node = scene.instances[0].to_world;  // its translation is zero
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 translation(translations[3 * i], translations[3 * i + 1], translations[3 * i + 2]);
    expect_near(scene.instances[i].to_world, {node.linear, node.point(translation)});
  }
  EXPECT_EQ(load_sample(instanced("")).scene.instances.size(), 1u) << "no attributes, no extension";
  EXPECT_EQ(load_sample(instanced(R"("_ID":1)")).scene.instances.size(), 3u) << "their number is that of the instances";
}

// 127 and 32767 stand for 1; quaternions are normalised, so that their rounding does not scale the mesh.
TEST(GltfInstancing, RotationsMayBeNormalizedIntegers) {
  for (const int type : {gl_byte, gl_short}) {
    GltfSample sample = instanced(R"("ROTATION":4)");
    if (type == gl_byte) {
      sample.add_accessor<std::int8_t>(type, "VEC4", 1, {90, 0, 0, 90}, ",\"normalized\":true");
    } else {
      sample.add_accessor<std::int16_t>(type, "VEC4", 1, {23170, 0, 0, 23170}, ",\"normalized\":true");
    }
    sample.nodes[0].replace(0, std::string(parent).size(), "{\"name\":\"n\"");
    const Scene scene = load_sample(sample).scene;
    ASSERT_EQ(scene.instances.size(), 1u);
    // Baked, since there is one: a quarter turn about +X takes (0 1 0) to (0 0 1).
    EXPECT_LT(glm::distance(scene.meshes.at(0).positions.at(2), Vec3(0, 0, 1)), 1e-5f);
  }
}

TEST(GltfInstancing, AnInstanceWithoutVolumeIsLeftOut) {
  GltfSample sample = instanced(R"("TRANSLATION":1,"SCALE":4)");
  sample.add_accessor<float>(gl_float, "VEC3", 3, {1, 1, 1, 0, 1, 1, 1, 1, 1});
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.instances.size(), 2u);
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(GltfInstancing, MistakesAreNamed) {
  const std::string place = "model.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing";
  GltfSample sample = instanced(R"("ROTATION":2,"TRANSLATION":4)");
  sample.add_accessor<float>(gl_float, "VEC3", 2, {0, 0, 0, 1, 1, 1});
  EXPECT_EQ(load_error(sample), place + ".attributes.TRANSLATION: has 2 elements, ROTATION has 3");
  EXPECT_EQ(load_error(instanced(R"("TRANSLATION":2)")),
            place + ".attributes.TRANSLATION: accessor 2 must be of type VEC3");
  EXPECT_EQ(load_error(instanced(R"("TRANSLATION":9)")),
            place + ".attributes.TRANSLATION: index 9 does not exist: there are 4 in accessors");
  // Zeros without a buffer view cost a file nothing.
  sample = instanced(R"("TRANSLATION":4)");
  sample.accessors.push_back(R"({"componentType":5126,"type":"VEC3","count":60000000})");
  EXPECT_EQ(load_error(sample), place + ": makes more than 2097152 instances in the scene");
  sample = instanced(R"("TRANSLATION":4)");
  sample.add_accessor<float>(gl_float, "VEC3", 1, {0, std::nanf(""), 0});
  EXPECT_EQ(load_error(sample), place + ": instance 0 is not finite");
}

}  // namespace
}  // namespace candil::test
