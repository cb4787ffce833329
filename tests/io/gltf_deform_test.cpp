#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/expect_near.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

/// The triangle (0 0 0), (1 0 0), (0 1 0) with all attributes, drawn by node 0.
struct MorphSample : GltfSample {
  MorphSample() {
    add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    add_accessor<float>(gl_float, "VEC2", 3, {0, 0, 1, 0, 0, 1});
    add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 0.5f, 0.5f, 0.5f, 1, 1, 1});
    nodes = {R"({"mesh":0})"};
  }
  /// `targets`, and `members` of the mesh behind them.
  void set_mesh(const std::string& targets, const std::string& members = "") {
    meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":3},"targets":[)" +
              targets + "]}]" + members + "}"};
  }
};

TEST(GltfMorph, AddsWeightedDisplacementsToEveryAttribute) {
  MorphSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 4, 0, 0, 8, 0, 0, 0});
  sample.add_accessor<float>(gl_float, "VEC3", 3, {2, 0, 0, 0, 0, 0, 0, 4, -2});
  sample.add_accessor<float>(gl_float, "VEC2", 3, {0.5f, 0, 0, 0.5f, 0, 0});
  sample.add_accessor<float>(gl_float, "VEC3", 3, {-1, 1, 0, 1, 1, 1, 1, 1, 1});
  sample.add_accessor<float>(gl_float, "VEC3", 3, {1, 0, 0, 1, 0, 0, 1, 0, 0});
  sample.set_mesh(R"({"POSITION":4,"NORMAL":5,"TEXCOORD_0":6,"COLOR_0":7},{"POSITION":8})", R"(,"weights":[0.5,2])");
  const Scene scene = load_sample(sample).scene;
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{2, 0, 2}, {3, 0, 4}, {2, 1, 0}}));
  const float h = std::sqrt(0.5f);
  expect_near(mesh.normals[0], {h, 0, h});  // (0 0 1) + (1 0 0)
  expect_near(mesh.normals[1], {0, 0, 1});
  expect_near(mesh.normals[2], {0, 1, 0});  // (0 0 1) + (0 2 -1)
  EXPECT_EQ(mesh.uvs[0], (std::vector<Vec2>{{0.25f, 0}, {1, 0.25f}, {0, 1}}));
  // Clamped; the alpha that VEC3 does not have is not displaced.
  EXPECT_EQ(mesh.colors, (std::vector<Vec4>{{0, 0.5f, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}));
}

// Two nodes with the mesh's weights and one with its own: two objects.
TEST(GltfMorph, WeightsOfTheNodeGoBeforeThoseOfTheMesh) {
  MorphSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  sample.set_mesh(R"({"POSITION":4})", R"(,"weights":[3])");
  sample.nodes = {R"({"mesh":0})", R"({"mesh":0,"weights":[0.25]})", R"({"mesh":0})"};
  const Scene scene = load_sample(sample).scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].object, scene.instances[2].object);
  EXPECT_EQ(scene.meshes.at(0).positions[0].z, 3);
  EXPECT_EQ(scene.meshes.at(1).positions[0].z, 0.25f);
}

TEST(GltfMorph, WithoutWeightsTheBaseIsShown) {
  MorphSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  sample.set_mesh(R"({"POSITION":4})");
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.meshes.at(0).positions[0].z, 0);
  EXPECT_TRUE(loaded.warnings.empty());
}

// Normalised bytes: 127 is 1, -64 is -64/127. A sparse target without a view moves vertex 2 alone.
TEST(GltfMorph, ReadsQuantisedAndSparseTargets) {
  MorphSample sample;
  sample.add_accessor<std::int8_t>(gl_byte, "VEC3", 3, {127, 0, 0, 0, 0, 0, 0, 0, -64, 0, 0, 0},
                                   ",\"normalized\":true");
  sample.views.back().insert(sample.views.back().size() - 1, ",\"byteStride\":4");
  const std::vector<std::uint8_t> which = {2};
  const std::vector<float> value = {0, 0, 5};
  const int indices = sample.add_view(std::as_bytes(std::span(which)));
  const int values = sample.add_view(std::as_bytes(std::span(value)));
  sample.accessors.push_back(
      R"({"componentType":5126,"type":"VEC3","count":3,"sparse":{"count":1,"indices":{"bufferView":)" +
      std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}}");
  sample.set_mesh(R"({"POSITION":4},{"POSITION":5})", R"(,"weights":[1,2])");
  const std::vector<Vec3> p = load_sample(sample).scene.meshes.at(0).positions;
  expect_near(p[0], {1, 0, 0});
  expect_near(p[1], {1, 0, 0});
  expect_near(p[2], {-64 / 127.0f, 1, 10});
}

TEST(GltfMorph, RefusesTargetsOfAnotherLengthAndWarnsOfOtherWeights) {
  MorphSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 2, {0, 0, 1, 0, 0, 1});
  sample.set_mesh(R"({"POSITION":4})");
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].targets[0].POSITION: accessor 4 has 2 elements, POSITION has 3");
  MorphSample other;
  other.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  other.set_mesh(R"({"POSITION":4})", R"(,"weights":[1,1,1])");
  EXPECT_EQ(load_sample(other).warnings, std::vector<std::string>{"nodes[0]: has 3 morph weights for 1 targets"});
}

// A thousand nodes that each add a thousand targets of a thousand vertices: a billion displacements in a few lines.
TEST(GltfMorph, RefusesWorkOutOfProportion) {
  GltfSample sample;
  sample.accessors.push_back(R"({"componentType":5126,"type":"VEC3","count":1000})");
  std::string targets, weights;
  for (int t = 0; t < 1000; ++t) {
    targets += (t == 0 ? "" : ",") + std::string(R"({"POSITION":0})");
    weights += (t == 0 ? "" : ",") + std::to_string(t + 1);
  }
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0},"targets":[)" + targets + "]}]}"};
  for (int n = 0; n < 1000; ++n) {
    sample.nodes.push_back(R"({"mesh":0,"weights":[)" + std::to_string(n) + "," + weights.substr(2) + "]}");
  }
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0]: expands to far more geometry than the file has "
            "bytes for");
}

/// A triangle bound to two joints, nodes 1 and 2: vertex 0 to the first, 1 to the second, 2 to both by half.
struct SkinSample : GltfSample {
  SkinSample() {
    add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
    add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
    add_accessor<std::uint8_t>(gl_unsigned_byte, "VEC4", 3, {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
    add_accessor<float>(gl_float, "VEC4", 3, {1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0});
    // The inverse bind matrix of joint 1 moves by (-1, 0, 0), that of joint 0 does nothing.
    add_accessor<float>(gl_float, "MAT4", 2, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
    meshes = {mesh(R"("JOINTS_0":2,"WEIGHTS_0":3)")};
    root = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4}])";
    set_nodes(R"("translation":[0,0,0])", R"("translation":[1,0,0])");
  }
  static std::string mesh(const std::string& attributes) {
    return R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,)" + attributes + "}}]}";
  }
  void set_nodes(const std::string& first, const std::string& second) {
    nodes = {R"({"mesh":0,"skin":0,"translation":[100,100,100],"scale":[7,7,7]})", "{" + first + ",\"children\":[2]}",
             "{" + second + "}"};
  }
  std::vector<Vec3> positions() const { return load_sample(*this).scene.meshes.at(0).positions; }
};

// In the bind pose every joint's transform times its inverse bind matrix is the identity, and the node's own transform
// must not count: the vertices are those of the file, to the bit.
TEST(GltfSkin, BindPoseIsTheUnskinnedMesh) {
  const LoadedScene loaded = load_sample(SkinSample());
  EXPECT_EQ(loaded.scene.meshes.at(0).positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(loaded.scene.meshes.at(0).normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_TRUE(loaded.warnings.empty());
}

// Joint 0 rises by 2; its child, joint 1, is turned a quarter about Y, which takes +X to -Z and +Z to +X, and scaled by
// 3. Vertex 1 is at joint 1's origin: (1, 2, 0). Vertex 2 seen from joint 1 is (-1, 1, 0): 3 (0, 1, 1) + (1, 2, 0) =
// (1, 5, 3), and (0, 3, 0) from joint 0; half-way: (0.5, 4, 1.5). The blended matrix of vertex 2 has the columns
// (I + 3 R) / 2: x (0.5, 0, -1.5), y (0, 2, 0), z (1.5, 0, 0.5); its inverse transpose takes z to x cross y, which is
// (3, 0, 1) over the determinant.
TEST(GltfSkin, BlendsJoints) {
  SkinSample sample;
  sample.set_nodes(R"("translation":[0,2,0])",
                   R"("translation":[1,0,0],"rotation":[0,0.70710678,0,0.70710678],"scale":[3,3,3])");
  const Scene scene = load_sample(sample).scene;
  const Mesh& mesh = scene.meshes.at(0);
  expect_near(mesh.positions[0], {0, 2, 0});
  expect_near(mesh.positions[1], {1, 2, 0});
  expect_near(mesh.positions[2], {0.5f, 4, 1.5f});
  expect_near(mesh.normals[0], {0, 0, 1});
  expect_near(mesh.normals[1], {1, 0, 0});
  expect_near(mesh.normals[2], glm::normalize(Vec3(3, 0, 1)));
}

TEST(GltfSkin, WithoutMatricesJointsMoveByThemselves) {
  SkinSample sample;
  sample.root = R"(,"skins":[{"joints":[1,2]}])";
  expect_near(sample.positions()[1], {2, 0, 0});
}

// Eight influences, four in each set: vertex 0 hangs on all of them by 1/8 and is moved by their mean, (0 + ... + 7)
// / 8.
TEST(GltfSkin, ReadsAnyNumberOfSets) {
  SkinSample sample;
  std::string joints;
  for (int j = 0; j < 8; ++j) {
    sample.nodes.push_back("{\"translation\":[0,0," + std::to_string(j) + "]}");
    joints += (j == 0 ? "" : ",") + std::to_string(3 + j);
  }
  sample.root = ",\"skins\":[{\"joints\":[" + joints + "]}]";
  sample.add_accessor<std::uint16_t>(gl_unsigned_short, "VEC4", 3, {0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 0, 0});
  sample.add_accessor<std::uint16_t>(gl_unsigned_short, "VEC4", 3, {4, 5, 6, 7, 7, 0, 0, 0, 0, 0, 0, 0});
  sample.add_accessor<float>(gl_float, "VEC4", 3, {0.125f, 0.125f, 0.125f, 0.125f, 0, 0, 0, 0, 1, 0, 0, 0});
  sample.add_accessor<float>(gl_float, "VEC4", 3, {0.125f, 0.125f, 0.125f, 0.125f, 1, 0, 0, 0, 0, 0, 0, 0});
  sample.meshes = {SkinSample::mesh(R"("JOINTS_0":5,"JOINTS_1":6,"WEIGHTS_0":7,"WEIGHTS_1":8)")};
  const std::vector<Vec3> p = sample.positions();
  expect_near(p[0], {0, 0, 3.5f});
  expect_near(p[1], {1, 0, 7});
  expect_near(p[2], {0, 1, 0});
}

// Weights of 2 and 2 are halves, with a warning; a vertex without weights follows its first joint; a step of a byte
// (254 for 255) is no reason to warn.
TEST(GltfSkin, NormalisesWeights) {
  SkinSample sample;
  sample.add_accessor<float>(gl_float, "VEC4", 3, {2, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "VEC4", 3, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
  sample.meshes = {SkinSample::mesh(R"("JOINTS_0":6,"WEIGHTS_0":5)")};
  sample.set_nodes(R"("translation":[0,0,0])", R"("translation":[1,0,4])");
  const LoadedScene loaded = load_sample(sample);
  const std::vector<Vec3>& p = loaded.scene.meshes.at(0).positions;
  expect_near(p[0], {0, 0, 2});
  expect_near(p[1], {1, 0, 4});
  expect_near(p[2], {0, 1, 0});
  EXPECT_EQ(
      loaded.warnings,
      std::vector<std::string>{"meshes[0].primitives[0]: has joint weights that do not sum to 1, they are normalised"});
  SkinSample bytes;
  bytes.add_accessor<std::uint8_t>(gl_unsigned_byte, "VEC4", 3, {255, 0, 0, 0, 255, 0, 0, 0, 127, 127, 0, 0},
                                   ",\"normalized\":true");
  bytes.meshes = {SkinSample::mesh(R"("JOINTS_0":2,"WEIGHTS_0":5)")};
  EXPECT_TRUE(load_sample(bytes).warnings.empty());
}

// Joints that mirror x: the corners come in the other order, so that the front still faces +Z.
TEST(GltfSkin, MirroringJointsKeepTheFront) {
  SkinSample sample;
  sample.set_nodes(R"("scale":[-1,1,1])", R"("translation":[1,0,0])");
  const Scene scene = load_sample(sample).scene;
  const Mesh& mesh = scene.meshes.at(0);
  expect_near(mesh.positions[1], {-1, 0, 0});
  expect_near(mesh.normals[1], {0, 0, 1});
  const Triangle t = mesh.triangles.at(0);
  EXPECT_GT(glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).z, 0);
}

TEST(GltfSkin, SkinnedMeshesAreNeverShared) {
  SkinSample sample;
  sample.nodes.push_back(R"({"mesh":0,"skin":1})");
  sample.nodes.push_back(R"({"mesh":0})");
  sample.nodes.push_back(R"({"translation":[0,0,9]})");
  sample.root = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4},{"joints":[5,5]}])";
  const Scene scene = load_sample(sample).scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  expect_near(scene.meshes.at(0).positions[0], {0, 0, 0});
  expect_near(scene.meshes.at(1).positions[0], {0, 0, 9});
  expect_near(scene.meshes.at(2).positions[0], {0, 0, 0});
}

TEST(GltfSkin, RefusesWhatIsNotThere) {
  SkinSample joints;
  joints.root = R"(,"skins":[{"joints":[1]}])";
  EXPECT_EQ(load_error(joints),
            "model.gltf: meshes[0].primitives[0].attributes.JOINTS_0: accessor 2 element 1: there is "
            "no joint 1, the skin has 1");
  SkinSample matrices;
  matrices.root = R"(,"skins":[{"joints":[1,2,1],"inverseBindMatrices":4}])";
  EXPECT_EQ(load_error(matrices), "model.gltf: skins[0].inverseBindMatrices: has 2 matrices for 3 joints");
  SkinSample kind;
  kind.root = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":3}])";
  EXPECT_EQ(load_error(kind), "model.gltf: skins[0].inverseBindMatrices: must be MAT4 of floats");
  SkinSample node;
  node.root = R"(,"skins":[{"joints":[1,3]}])";
  EXPECT_EQ(load_error(node), "model.gltf: skins[0].joints[1]: index 3 does not exist: there are 3 in nodes");
  SkinSample none;
  none.root = R"(,"skins":[{"joints":[]}])";
  EXPECT_EQ(load_error(none), "model.gltf: skins[0].joints: must not be empty");
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  SkinSample values;
  values.add_accessor<float>(gl_float, "MAT4", 2, {nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                                                   1,   0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  values.root = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":5}])";
  EXPECT_EQ(load_error(values),
            "model.gltf: skins[0].inverseBindMatrices: element 0 is not finite, or its joint's transform is not");
}

TEST(GltfSkin, WeightsThatAreNoneCountAsZero) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  SkinSample sample;
  sample.add_accessor<float>(gl_float, "VEC4", 3, {1, nan, 0, 0, 1, -3, 0, 0, 1, 0, 0, 0});
  sample.meshes = {SkinSample::mesh(R"("JOINTS_0":2,"WEIGHTS_0":5)")};
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.meshes.at(0).positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(GltfSkin, MeshesWithoutJointsAreLeftWhereTheirNodeIs) {
  SkinSample sample;
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]})"};
  const LoadedScene loaded = load_sample(sample);
  expect_near(loaded.scene.meshes.at(0).positions[1], {107, 100, 100});
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

}  // namespace
}  // namespace candil::test
