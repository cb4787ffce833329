/// docs/scene-format.md, the schema and the scenes that ship agree with the loader.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "io/error.h"
#include "io/image_file.h"
#include "io/json_schema.h"
#include "tests/io/json_sample.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

const std::filesystem::path scenes = CANDIL_SCENES_DIR;

std::vector<std::string> documented_examples() {
  const std::string page = read_text(scenes / "../docs/scene-format.md");
  const std::string begin = "```json\n", end = "\n```";
  std::vector<std::string> examples;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    examples.push_back(page.substr(at, page.find(end, at) - at));
  }
  return examples;
}

/// Names of all properties anywhere in the schema.
void collect_properties(const nlohmann::json& node, std::set<std::string>& names) {
  if (node.is_object() && node.contains("properties"))
    for (const auto& [name, rules] : node.at("properties").items()) names.insert(name);
  if (node.is_structured())
    for (const auto& child : node) collect_properties(child, names);
}

/// What the examples refer to.
void write_files(const TemporaryFolder& folder) {
  write_text(folder / "box.json", R"({"objects": []})");
  write_grey_png(folder / "wood.png", 2, 2, {0, 80, 160, 240});
  write_text(folder / "bunny.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  GltfSample lamp;
  lamp.add_triangle();
  write_text(folder / "lamp.gltf", lamp.json());
  write_image(folder / "sky.pfm", Image(4, 2, 3), false, {});
}

TEST(SceneFormatPage, ItsExamplesLoad) {
  const TemporaryFolder folder;
  write_files(folder);
  const std::vector<std::string> examples = documented_examples();
  EXPECT_GE(examples.size(), 9U);
  for (const std::string& example : examples) EXPECT_EQ(json_error(folder, example), "") << example;
}

TEST(SceneFormatPage, ExplainsEveryKeyOfTheSchemaWithAnExample) {
  const std::string page = read_text(scenes / "../docs/scene-format.md");
  std::string examples;
  for (const std::string& example : documented_examples()) examples += example;
  std::set<std::string> names;
  collect_properties(nlohmann::json::parse(read_text(scenes / "candil-scene.schema.json")), names);
  EXPECT_GT(names.size(), 70U);
  for (const std::string& name : names) {
    EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name << " is not explained";
    EXPECT_NE(examples.find("\"" + name + "\""), std::string::npos) << name << " has no example";
  }
}

TEST(SceneSchema, HoldsOnlyWhatTheCheckKnows) {
  EXPECT_NO_THROW(JsonSchema(read_text(scenes / "candil-scene.schema.json")));
  EXPECT_THROW(JsonSchema(R"({"type": "object", "patternProperties": {}})"), std::invalid_argument);
  EXPECT_THROW(JsonSchema("{"), std::invalid_argument);
}

TEST(SceneSchema, SuggestsOnlySimilarNames) {
  EXPECT_EQ(most_similar("raduis", {"center", "radius", "material"}), "radius");
  EXPECT_EQ(most_similar("kD", {"kd", "ks"}), "kd");
  EXPECT_EQ(most_similar("colour", {"radius", "material"}), "");
}

// Each says in its "$schema" where the schema is, as an editor follows it.
TEST(ReportScenes, LoadAndNameTheSchema) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes / "report")) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    const nlohmann::json root = nlohmann::json::parse(read_text(entry.path()), nullptr, true, true);
    const std::filesystem::path schema = entry.path().parent_path() / root.value("$schema", "missing");
    EXPECT_TRUE(std::filesystem::equivalent(schema, scenes / "candil-scene.schema.json")) << entry.path();
    try {
      EXPECT_TRUE(load_scene(entry.path()).warnings.empty()) << entry.path();
    } catch (const InputError& error) {
      const std::string message = error.what();  // models that are fetched or made (./dev models) may be missing
      EXPECT_TRUE(message.find("\"models/") != message.npos && message.ends_with("does not exist")) << message;
    }
  }
  EXPECT_GE(count, 30);
}

}  // namespace
}  // namespace candil::test
