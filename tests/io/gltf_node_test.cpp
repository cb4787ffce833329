#include <gtest/gtest.h>

#include <cmath>

#include "io/error.h"
#include "tests/support/expect_near.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

/// The triangle of GltfSample with nodes and further root members in place of its own.
GltfSample sample_with_nodes(std::vector<std::string> nodes, const std::string& root = "") {
  GltfSample sample;
  sample.add_triangle();
  sample.nodes = std::move(nodes);
  sample.root = root;
  return sample;
}

// Translation * rotation * scale: (1, 0, 0) is scaled to (2, 0, 0), turned a quarter about Z to (0, 2, 0), moved to
// (10, 2, 0). The single instance is baked into world space.
TEST(GltfNode, AppliesScaleThenRotationThenTranslation) {
  const Scene scene = load_sample(sample_with_nodes({R"({"mesh":0,"translation":[10,0,0],"scale":[2,3,4],
      "rotation":[0,0,0.70710678,0.70710678]})"}))
                          .scene;
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(scene.instances[0].is_world_space);
  const std::vector<Vec3>& p = scene.meshes.at(0).positions;
  expect_near(p[0], {10, 0, 0});
  expect_near(p[1], {10, 2, 0});
  expect_near(p[2], {7, 0, 0});
}

// Column-major: the last four numbers are the translation's column.
TEST(GltfNode, ReadsMatrices) {
  const Scene scene =
      load_sample(sample_with_nodes({R"({"mesh":0,"matrix":[0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1]})"})).scene;
  const std::vector<Vec3>& p = scene.meshes.at(0).positions;
  expect_near(p[0], {5, 6, 7});
  expect_near(p[1], {5, 7, 7});
  expect_near(p[2], {4, 6, 7});
}

TEST(GltfNode, ChildrenFollowTheirParents) {
  const Scene scene = load_sample(sample_with_nodes({R"({"children":[1],"translation":[1,0,0],"scale":[2,2,2]})",
                                                     R"({"children":[2],"translation":[1,0,0]})",
                                                     R"({"mesh":0,"translation":[0,1,0]})"}))
                          .scene;
  expect_near(scene.meshes.at(0).positions[0], {3, 2, 0});  // 1 + 2 (1 + 0), 2 (0 + 1)
}

// Specification, section 3.7.4: a negative determinant reverses the winding, so that the front stays the front.
// Mirrored in x, the triangle still must be counter-clockwise seen from +Z.
TEST(GltfNode, NegativeScaleKeepsTheFrontSide) {
  const Mesh mesh = load_sample(sample_with_nodes({R"({"mesh":0,"scale":[-1,1,1]})"})).scene.meshes.at(0);
  const Triangle t = mesh.triangles.at(0);
  const Vec3 normal = glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
  EXPECT_GT(normal.z, 0);
  EXPECT_EQ(mesh.positions[1], Vec3(-1, 0, 0));
}

TEST(GltfNode, MeshesUsedTwiceAreInstances) {
  const Scene scene =
      load_sample(sample_with_nodes({R"({"mesh":0,"name":"a"})", R"({"mesh":0,"translation":[0,0,5]})"})).scene;
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.objects.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].name, "a");
  EXPECT_FALSE(scene.instances[0].is_world_space);
  EXPECT_EQ(scene.instances[1].to_world.translation, Vec3(0, 0, 5));
}

TEST(GltfNode, ShowsTheSceneThatIsChosen) {
  const auto shown = [](const std::string& choice) {
    std::string names;
    const GltfSample sample = sample_with_nodes({R"({"mesh":0,"name":"a"})", R"({"mesh":0,"name":"b"})"},
                                                R"(,"scenes":[{"name":"1","nodes":[0]},{"nodes":[1]}])");
    LoadOptions options;
    options.scene = choice;
    for (const Instance& instance : load_sample(sample, options).scene.instances) names += instance.name;
    return names;
  };
  EXPECT_EQ(shown(""), "a");
  EXPECT_EQ(shown("1"), "a") << "a name goes before an index";
  EXPECT_EQ(shown("0"), "a");
  EXPECT_THROW(shown("2"), InputError);
  EXPECT_THROW(shown("c"), InputError);
  EXPECT_THROW(shown("0x"), InputError);
}

TEST(GltfNode, ShowsTheDefaultSceneOnly) {
  const std::vector<std::string> nodes = {R"({"mesh":0,"name":"a"})", R"({"mesh":0,"name":"b"})"};
  const auto shown = [&](const std::string& root) {
    std::string names;
    for (const Instance& i : load_sample(sample_with_nodes(nodes, root)).scene.instances) names += i.name;
    return names;
  };
  const std::string scenes = R"(,"scenes":[{"nodes":[0]},{"nodes":[1]},{}])";
  EXPECT_EQ(shown(scenes + ",\"scene\":1"), "b");
  EXPECT_EQ(shown(scenes + ",\"scene\":2"), "");
  EXPECT_EQ(shown(scenes), "a") << "the first scene when none is the default";
  EXPECT_EQ(shown(""), "ab") << "all nodes when there are no scenes";
  EXPECT_EQ(load_error(sample_with_nodes(nodes, scenes + ",\"scene\":3")),
            "model.gltf: scene: index 3 does not exist: there are 3 in scenes");
}

TEST(GltfNode, HidesInvisibleNodesAndWhatIsBelow) {
  const Scene scene =
      load_sample(sample_with_nodes(
                      {R"({"children":[1],"extensions":{"KHR_node_visibility":{"visible":false}}})", R"({"mesh":0})",
                       R"({"mesh":0,"name":"shown","extensions":{"KHR_node_visibility":{"visible":true}}})"}))
          .scene;
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "shown");
}

TEST(GltfNode, RefusesCyclesAndSecondParents) {
  EXPECT_EQ(load_error(sample_with_nodes({R"({"children":[1]})", R"({"children":[2]})", R"({"children":[1]})"})),
            "model.gltf: nodes[2].children[0]: node 1 already is a child of node 0");
  EXPECT_EQ(load_error(sample_with_nodes({R"({"mesh":0})", R"({"children":[2]})", R"({"children":[1]})"})),
            "model.gltf: nodes[1]: is its own ancestor: the node hierarchy has a cycle");
  EXPECT_EQ(load_error(sample_with_nodes({R"({"children":[0]})"})),
            "model.gltf: nodes[0]: is its own ancestor: the node hierarchy has a cycle");
  EXPECT_EQ(load_error(sample_with_nodes({R"({"children":[1,1]})", "{}"})),
            "model.gltf: nodes[0].children[1]: node 1 already is a child of node 0");
}

// Recursion over a chain of this length would overflow the stack.
TEST(GltfNode, WalksDeepHierarchies) {
  constexpr int depth = 200000;
  std::vector<std::string> nodes;
  for (int n = 0; n + 1 < depth; ++n) nodes.push_back("{\"children\":[" + std::to_string(n + 1) + "]}");
  nodes.push_back(R"({"mesh":0,"translation":[0,0,1]})");
  expect_near(load_sample(sample_with_nodes(std::move(nodes))).scene.meshes.at(0).positions[0], {0, 0, 1});
}

TEST(GltfNode, TransformsThatOverflowAreRefusedAndFlatOnesNotShown) {
  EXPECT_EQ(
      load_error(sample_with_nodes({R"({"children":[1],"scale":[1e30,1,1]})", R"({"mesh":0,"scale":[1e30,1,1]})"})),
      "model.gltf: nodes[1]: has a transform that overflows");
  EXPECT_EQ(load_error(sample_with_nodes({R"({"mesh":0,"scale":[1e30,1,1]})"})),
            "model.gltf: nodes[0]: places its mesh farther than 1e9 m from the origin");
  // The last one has a determinant of 1e-20, but would lengthen the rays that enter it 1e20 times.
  for (const char* const node : {R"({"mesh":0,"scale":[0,0,0]})", R"({"mesh":0,"scale":[1e-20,1,1]})"}) {
    const LoadedScene loaded = load_sample(sample_with_nodes({node}));
    EXPECT_TRUE(loaded.scene.instances.empty()) << node;
    EXPECT_EQ(loaded.warnings.size(), 1u) << node;
  }
}

}  // namespace
}  // namespace candil::test
