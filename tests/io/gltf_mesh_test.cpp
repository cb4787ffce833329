#include <gtest/gtest.h>

#include <limits>

#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

/// Five vertices in a zigzag, drawn in the given mode without indices.
std::vector<Triangle> triangles_of_mode(int mode) {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 5, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  sample.add_triangle("", ",\"mode\":" + std::to_string(mode));
  return load_sample(sample).scene.meshes.at(0).triangles;
}

// Windings of the specification's section 3.7.2.1: strip p_i = {v_i, v_(i + 1 + i%2), v_(i + 2 - i%2)}, fan
// p_i = {v_(i + 1), v_(i + 2), v_0}.
TEST(GltfMesh, AssemblesStripsAndFans) {
  EXPECT_EQ(triangles_of_mode(5), (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles_of_mode(6), (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfMesh, StripsMayRestartByRepeatedVertices) {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 6, {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0});
  sample.add_triangle("", ",\"mode\":5,\"indices\":1");
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 8, {0, 1, 2, 2, 3, 3, 4, 5});
  EXPECT_EQ(load_sample(sample).scene.meshes.at(0).triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 5, 4}}));
}

TEST(GltfMesh, IncompleteTriangleIsLeftOut) {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 4, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  sample.add_triangle();
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.meshes.at(0).triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(GltfMesh, PointsAndLinesAreSkippedWithOneWarningEach) {
  GltfSample sample;
  sample.add_triangle("", ",\"mode\":0");
  sample.add_triangle("", ",\"mode\":0");
  for (const char* mode : {"1", "2", "3"}) sample.add_triangle("", std::string(",\"mode\":") + mode);
  const LoadedScene loaded = load_sample(sample);
  EXPECT_TRUE(loaded.scene.meshes.empty());
  EXPECT_TRUE(loaded.scene.instances.empty());
  EXPECT_EQ(loaded.warnings,
            (std::vector<std::string>{"primitives of points are not shown; --point-radius METRES shows them as spheres",
                                      "primitives of lines are not shown; --point-radius METRES shows them as tubes"}));
  EXPECT_EQ(loaded.thin.points, 6u);
  EXPECT_EQ(loaded.thin.lines, 1u + 3u + 2u) << "a line (and a vertex left over), a loop of three, a strip of two";
  sample.add_triangle("", ",\"mode\":7");
  EXPECT_EQ(load_error(sample), "model.gltf: meshes[5].primitives[0].mode: 7 is not a mode of glTF");
}

TEST(GltfMesh, PrimitivesOfAMeshAreOneObject) {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  sample.materials = {R"({"name":"red"})", R"({"name":"green"})"};
  sample.meshes = {R"({"name":"two","primitives":[{"attributes":{"POSITION":0},"material":1},
                      {"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0}}]})"};
  sample.nodes = {R"({"mesh":0})"};
  const Scene scene = load_sample(sample).scene;
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "two");
  EXPECT_EQ(scene.objects[0].mesh_count, 2u);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.materials.at(scene.meshes[0].material).name, "green");
  EXPECT_EQ(scene.materials.at(scene.meshes[1].material).metallic, 1) << "the default material";
}

TEST(GltfMesh, NormalsAbsentMeansFlat) {
  GltfSample sample;
  sample.add_triangle();
  EXPECT_TRUE(load_sample(sample).scene.meshes.at(0).normals.empty());
}

// The triangle lies in z = 0, counter-clockwise seen from +Z: its geometric normal is +Z.
TEST(GltfMesh, RepairsNormals) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  GltfSample sample;
  sample.add_triangle(",\"NORMAL\":1");
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 3e-20f, 0, 0, 0, 0, nan, 0, 0});
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.meshes.at(0).normals, (std::vector<Vec3>{{0, 1, 0}, {0, 0, 1}, {0, 0, 1}}));
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(GltfMesh, RefusesPositionsThatAreNotFinite) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    GltfSample sample;
    sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, bad});
    sample.add_triangle();
    EXPECT_EQ(load_error(sample),
              "model.gltf: meshes[0].primitives[0].attributes.POSITION: accessor 0 element 2 is not finite");
  }
}

TEST(GltfMesh, RefusesAttributesOfAnotherLengthOrShape) {
  GltfSample sample;
  sample.add_triangle(",\"NORMAL\":1");
  sample.add_accessor<float>(gl_float, "VEC3", 2, {0, 0, 1, 0, 0, 1});
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].attributes.NORMAL: accessor 1 has 2 elements, POSITION has 3");
  sample.accessors.pop_back();
  sample.add_accessor<float>(gl_float, "VEC2", 3, {0, 0, 1, 0, 0, 1});
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0].attributes.NORMAL: accessor 1 must be of type VEC3");
}

TEST(GltfMesh, DamageInMeshesThatAreNotShownIsReportedToo) {
  GltfSample sample;
  sample.add_triangle();
  sample.add_triangle("", ",\"indices\":1");
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 3, {0, 1, 9});
  sample.nodes.pop_back();
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[1].primitives[0].indices: accessor 1 element 2 is 9, beyond the last "
            "vertex; the mesh has 3 vertices");
}

// One small accessor that very many primitives expand: 3 million bytes of JSON must not become hundreds of gigabytes.
TEST(GltfMesh, RefusesGeometryOutOfProportion) {
  GltfSample sample;
  sample.accessors.push_back(R"({"componentType":5126,"type":"VEC3","count":60000000})");
  std::string primitives;
  for (int p = 0; p < 100; ++p) primitives += std::string(p == 0 ? "" : ",") + R"({"attributes":{"POSITION":0}})";
  sample.meshes.push_back("{\"primitives\":[" + primitives + "]}");
  EXPECT_EQ(load_error(sample),
            "model.gltf: meshes[0].primitives[0]: expands to far more geometry than the file has bytes for");
}

}  // namespace
}  // namespace candil::test
