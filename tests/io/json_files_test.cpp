/// PLY and glTF files that JSON scenes name: read once, checked, limited.
#include <gtest/gtest.h>

#include "io/error.h"
#include "io/json_internal.h"
#include "tests/io/json_sample.h"
#include "tests/io/ply_sample.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

std::string triangle_ply() { return ascii_ply({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"3 0 1 2"}); }

TEST(JsonPly, SameFileAndOptionsAreOneMesh) {
  const TemporaryFolder folder;
  write_text(folder / "a.ply", triangle_ply());
  const LoadedScene loaded = load_json(folder, R"({"materials": {"m": {"type": "mirror"}}, "objects": [
    {"type": "ply", "file": "a.ply"},
    {"type": "ply", "file": "./a.ply", "transform": [{"translate": [5, 0, 0]}]},
    {"type": "ply", "file": "a.ply", "normals": "smooth"},
    {"type": "ply", "file": "a.ply", "material": "m"},
    {"type": "ply", "file": "a.ply", "material": "m", "instances": [[], [{"scale": 2}]]}]})");
  const Scene& scene = loaded.scene;
  ASSERT_EQ(scene.meshes.size(), 3U);
  EXPECT_TRUE(scene.meshes[0].normals.empty());
  EXPECT_EQ(scene.meshes[1].normals.size(), 3U);
  EXPECT_TRUE(scene.meshes[2].normals.empty());
  EXPECT_NE(scene.meshes[0].material, scene.meshes[2].material);
  std::vector<int> uses(3);
  for (const Instance& instance : scene.instances) ++uses[instance.object];
  EXPECT_EQ(uses, (std::vector<int>{2, 1, 3}));
}

TEST(JsonPly, MessagesNameTheObject) {
  const TemporaryFolder folder;
  write_text(folder / "bad.ply", "ply\n");
  const std::string message = json_error(folder, R"({"objects": [{"type": "ply", "file": "bad.ply"}]})");
  EXPECT_TRUE(message.starts_with("scene.json: objects[0].file: ")) << message;
  EXPECT_TRUE(message.ends_with("bad.ply: header: has no end_header")) << message;
}

TEST(JsonPly, PointsAreAWarningAndNothingElse) {
  const TemporaryFolder folder;
  write_text(folder / "points.ply", "ply\nformat ascii 1.0\n" + vertex_element(1) + "end_header\n0 0 0\n");
  const LoadedScene loaded = load_json(folder, R"({"objects": [{"type": "ply", "file": "points.ply"},
    {"type": "ply", "file": "points.ply"}]})");
  EXPECT_TRUE(loaded.scene.meshes.empty());
  EXPECT_TRUE(loaded.scene.instances.empty());
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"objects[0]: the file has no faces, nothing of it is shown"});
}

TEST(JsonGltf, SameFileIsReadOnce) {
  const TemporaryFolder folder;
  GltfSample sample;
  sample.add_triangle();
  write_text(folder / "a.gltf", sample.json());
  const LoadedScene loaded = load_json(folder, R"({"objects": [
    {"type": "gltf", "file": "a.gltf"}, {"type": "gltf", "file": "a.gltf", "transform": [{"translate": [0, 7, 0]}]},
    {"type": "gltf", "file": "a.gltf", "material": {"type": "mirror"}}]})");
  const Scene& scene = loaded.scene;
  ASSERT_EQ(scene.meshes.size(), 2U);  // one for each material
  ASSERT_EQ(scene.instances.size(), 3U);
  EXPECT_EQ(scene.instances[0].object, scene.instances[1].object);
  EXPECT_EQ(scene.instances[1].to_world.translation, Vec3(0, 7, 0));
  EXPECT_EQ(scene.materials[scene.meshes[1].material].model, MaterialModel::phong);
}

// 2000 copies of 1000 lights are two million.
TEST(JsonGltf, LightsAreLimited) {
  const TemporaryFolder folder;
  GltfSample sample;
  sample.root = R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
    {"type":"point"}]}})";
  for (int i = 0; i < 1000; ++i) sample.nodes.push_back(R"({"extensions":{"KHR_lights_punctual":{"light":0}}})");
  write_text(folder / "lights.gltf", sample.json());
  std::string instances = "[]";
  for (int i = 1; i < 2000; ++i) instances += ",[]";
  const std::string object = R"({"objects": [{"type": "gltf", "file": "lights.gltf", "instances": [)";
  EXPECT_EQ(json_error(folder, object + "[]]}]}"), "");
  EXPECT_EQ(json_error(folder, object + instances + "]}]}"),
            "scene.json: objects[0]: makes more than a million lights");
}

// What a file brings is placed by its object: within reach, and never without a direction.
TEST(JsonGltf, LightsAndCamerasStayWithinReach) {
  const TemporaryFolder folder;
  GltfSample sample;
  sample.root = R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[
    {"type":"spot","spot":{}}]}})";
  sample.cameras = {R"({"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}})"};
  sample.nodes = {R"({"camera":0,"translation":[1,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}})"};
  write_text(folder / "a.gltf", sample.json());
  const auto scene = [](const std::string& members) {
    return R"({"objects": [{"type": "gltf", "file": "a.gltf", )" + members + "}]}";
  };
  EXPECT_EQ(json_error(folder, scene(R"("transform": [{"translate": [1e9, 0, 0]}, {"translate": [1e9, 0, 0]}])")),
            "scene.json: objects[0]: places a light farther than 1e9 m from the origin");
  EXPECT_EQ(json_error(folder, scene(R"("lights": false, "cameras": true, "transform": [{"scale": 1e5},
                                        {"scale": 1e5}])")),
            "scene.json: objects[0]: places a camera too far away, or scales it to nothing");
  const LoadedScene loaded = load_json(folder, scene(R"("cameras": true, "transform": [{"scale": 1e-7},
                                                        {"rotate_y": -90}])"));
  EXPECT_EQ(loaded.scene.cameras.size(), 1U);
  ASSERT_EQ(loaded.scene.punctual_lights.size(), 1U);
  EXPECT_NEAR(loaded.scene.punctual_lights[0].direction.x, 1, 1e-6f);  // -Z turned by a quarter
}

TEST(JsonFiles, LongNamesAreKeptShort) {
  const TemporaryFolder folder;
  write_text(folder / "a.ply", triangle_ply());
  // 199 bytes, then a character of two: it does not fit into 200 bytes.
  const std::string name = std::string(199, 'n') + "\u00e9" + std::string(1000, 'n');
  GltfSample sample;
  sample.add_triangle();
  sample.nodes = {R"({"mesh":0,"name":")" + name + R"("})"};
  write_text(folder / "a.gltf", sample.json());
  const std::string member = R"(, "name": ")" + name + R"(")";
  const Scene scene = load_json(folder, R"({"objects": [{"type": "ply", "file": "a.ply")" + member + R"(},
    {"type": "gltf", "file": "a.gltf"}, {"type": "sphere", "center": [0, 0, 0], "radius": 1)" +
                                            member + R"(},
    {"type": "quad", "corners": [[0, 1, 0], [1, 1, 0], [0, 0, 0]])" +
                                            member + R"(}]})")
                          .scene;
  ASSERT_EQ(scene.instances.size(), 3U);
  for (const Instance& instance : scene.instances) EXPECT_EQ(instance.name, std::string(199, 'n'));
  EXPECT_EQ(scene.shapes.at(0).name, std::string(199, 'n'));
}

// Each material reads the file anew: what is charged for it is its size, although nothing of it is shown.
TEST(JsonFiles, FilesThatAreEmptyInsideAreCharged) {
  const TemporaryFolder folder;
  write_text(folder / "points.ply", "ply\nformat ascii 1.0\n" + vertex_element(1) + "end_header\n0 0 0\n");
  std::filesystem::resize_file(folder / "points.ply", std::uintmax_t{5} << 30);  // a hole, not read
  JsonGeometryFiles files;
  write_text(folder / "scene.json", "{}");
  const std::vector<JsonFile> read = read_json_files(folder / "scene.json");
  const JsonNode root(read.front());
  EXPECT_EQ(files.charge_file(root, folder / "points.ply"), std::size_t{5} << 30);
  EXPECT_THROW(files.charge_file(root, folder / "points.ply"), InputError);
}

// The first 80 characters of two names are the same; messages cut them there.
TEST(JsonMaterial, LongNamesAreNotConfused) {
  const std::string name(100, 'm');
  const LoadedScene loaded = load_json(R"({"materials": {")" + name + R"(1": {"type": "mirror"}, ")" + name +
                                       R"(2": {"type": "lambertian"}}, "objects": [
      {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": ")" +
                                       name + R"(1"},
      {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": ")" +
                                       name + R"(2"}]})");
  ASSERT_EQ(loaded.scene.materials.size(), 2U);
  EXPECT_EQ(loaded.scene.materials[0].model, MaterialModel::phong);
  EXPECT_EQ(loaded.scene.materials[1].model, MaterialModel::metallic_roughness);
}

}  // namespace
}  // namespace candil::test
