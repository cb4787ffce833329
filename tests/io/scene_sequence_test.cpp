#include "io/scene_sequence.h"

#include <gtest/gtest.h>

#include "io/error.h"
#include "tests/io/image_samples.h"
#include "tests/support/gltf/animated_sample.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {
namespace {

bool is_same(const Scene& a, const Scene& b) {
  bool is_equal = a.meshes.size() == b.meshes.size() && a.images.size() == b.images.size() &&
                  a.instances.size() == b.instances.size() && a.materials.size() == b.materials.size();
  for (std::size_t m = 0; m < a.meshes.size() && is_equal; ++m) {
    is_equal = a.meshes[m].positions == b.meshes[m].positions && a.meshes[m].normals == b.meshes[m].normals &&
               a.meshes[m].tangents == b.meshes[m].tangents && a.meshes[m].triangles == b.meshes[m].triangles &&
               a.meshes[m].material == b.meshes[m].material;
  }
  for (std::size_t i = 0; i < a.images.size() && is_equal; ++i) is_equal = a.images[i].rgba8 == b.images[i].rgba8;
  for (std::size_t m = 0; m < a.materials.size() && is_equal; ++m) {
    is_equal = a.materials[m].base_color == b.materials[m].base_color;
  }
  return is_equal;
}

// Two objects, one of which vanishes with its texture for a while; times in any order, images given back or not.
TEST(SceneSequence, GivesWhatAStillGives) {
  AnimatedSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  sample.add_accessor<float>(gl_float, "VEC2", 3, {0, 0, 1, 0, 0, 1});
  sample.add_triangle(",\"TEXCOORD_0\":1", ",\"material\":0");
  sample.add_triangle(",\"TEXCOORD_0\":1", ",\"material\":1");
  sample.images = {"{\"uri\":\"data:image/png;base64," + std::string(png_rgba8) + "\"}",
                   "{\"uri\":\"data:image/png;base64," + std::string(png_grey8) + "\"}"};
  sample.textures = {R"({"source":0})", R"({"source":1})"};
  sample.materials = {R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})",
                      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}},
                          "normalTexture":{"index":1,"extensions":{"KHR_texture_transform":{}}}})"};
  sample.nodes[0] = R"({"mesh":0,"extensions":{"KHR_node_visibility":{}}})";
  sample.move("/nodes/0/extensions/KHR_node_visibility/visible", "SCALAR", {0, 1, 2}, {1, 0, 1}, "STEP");
  sample.move("/nodes/1/translation", "VEC3", {0, 3}, {0, 0, 0, 0.3f, 7, 1});
  sample.move("/materials/1/pbrMetallicRoughness/baseColorFactor", "VEC4", {0, 3}, {0, 0, 0, 1, 1, 1, 1, 1});
  // Tangents that are not in the file follow the texture.
  sample.move("/materials/1/normalTexture/extensions/KHR_texture_transform/rotation", "SCALAR", {0, 3}, {0, 3});
  const std::string text = sample.animated_json();
  const TemporaryFolder folder;
  write_text(folder / "model.gltf", text);
  SceneSequence sequence(folder / "model.gltf", {});
  std::vector<Scene> seen;
  for (const double seconds : {0.0, 0.3, 1.2, 2.5, 1.7, 0.3, 9.0}) {
    LoadedScene loaded = sequence.at(seconds);
    EXPECT_TRUE(is_same(loaded.scene, load_text(text, options_at(seconds)).scene)) << seconds;
    for (const Scene& other : seen) EXPECT_FALSE(is_same(loaded.scene, other)) << "the test sees differences";
    if (seconds < 0.3) seen.push_back(loaded.scene);
    if (seconds != 2.5) sequence.recycle(std::move(loaded.scene));
  }
}

TEST(SceneSequence, KnowsTheWholeMotion) {
  AnimatedSample sample = movable_triangle();
  sample.move_node(0, "translation", "VEC3", {0, 4}, {0, 0, 0, 20, 0, 0});
  const TemporaryFolder folder;
  write_text(folder / "model.gltf", sample.animated_json());
  SceneSequence sequence(folder / "model.gltf", {});
  Bounds bounds;
  for (const Vec3 point : sequence.motion().outline) bounds.add(point);
  EXPECT_EQ(bounds.low, Vec3(0, 0, 0));
  EXPECT_EQ(bounds.high, Vec3(21, 1, 0));
  EXPECT_FALSE(sequence.motion().has_light);
}

TEST(SceneSequence, RefusesFilesWithoutAnimations) {
  const TemporaryFolder folder;
  write_text(folder / "model.gltf", movable_triangle().json());
  EXPECT_THROW(SceneSequence(folder / "model.gltf", {}), InputError);
  write_text(folder / "mesh.ply", "ply\n");
  EXPECT_THROW(SceneSequence(folder / "mesh.ply", {}), InputError);
}

}  // namespace
}  // namespace candil::test
