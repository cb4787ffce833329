#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

TEST(Info, TellsAPersonWhatIsThere) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const ProgramResult result = run_program({"info", "square.gltf"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  for (const char* const text : {"square.gltf", "2 (2 with instances)", "2 x 2 x 0 m", "cameras      0", "0 point"})
    EXPECT_NE(result.output.find(text), std::string::npos) << text << "\n" << result.output;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"square.gltf"});
}

TEST(Info, JsonParsesAndCounts) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const ProgramResult result = run_program({"info", "--json", "square.gltf"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  const nlohmann::json info = nlohmann::json::parse(result.output);
  EXPECT_EQ(info["meshes"], 1);
  EXPECT_EQ(info["triangles"], 2);
  EXPECT_EQ(info["instanced_triangles"], 2);
  EXPECT_EQ(info["instances"], 1);
  EXPECT_EQ(info["bounds"]["low"], nlohmann::json({-1.0, -1.0, 0.0}));
  EXPECT_EQ(info["bounds"]["high"], nlohmann::json({1.0, 1.0, 0.0}));
  EXPECT_EQ(info["images"].size(), 0u);
  EXPECT_EQ(info["lights"]["emissive_triangles"], 0);
  EXPECT_EQ(info["cameras"].size(), 0u);
  EXPECT_TRUE(info["warnings"].is_array());
  EXPECT_TRUE(info["extensions_unsupported"].empty());
}

TEST(Info, CountsShapes) {
  const TemporaryFolder folder;
  write_text(folder / "shapes.json", R"({"materials": {"lamp": {"type": "emitter", "emission": 1}}, "objects": [
    {"type": "sphere", "center": [0, 0, 0], "radius": 1, "instances": [[], [{"translate": [3, 0, 0]}]]},
    {"type": "sphere", "center": [0, 3, 0], "radius": 1, "material": "lamp"},
    {"type": "disc", "center": [0, 5, 0], "normal": [0, -1, 0], "radius": 1, "material": "lamp"},
    {"type": "plane", "point": [0, -1, 0], "normal": [0, 1, 0]}]})");
  const ProgramResult result = run_program({"info", "--json", "shapes.json"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const nlohmann::json info = nlohmann::json::parse(result.output);
  EXPECT_EQ(info["shapes"], nlohmann::json({{"sphere", 3}, {"disc", 1}, {"plane", 1}}));
  EXPECT_EQ(info["lights"]["emissive_shapes"], 2);
  const ProgramResult text = run_program({"info", "shapes.json"}, folder.path());
  for (const char* const line : {"3 spheres, 1 discs, 1 planes", "2 emissive shapes"})
    EXPECT_NE(text.output.find(line), std::string::npos) << text.output;
}

TEST(Info, NamesCamerasLightsAndUnknownExtensions) {
  const TemporaryFolder folder;
  write_text(folder / "lamp.gltf", R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "extensionsUsed": ["KHR_lights_punctual", "ACME_flying_carpet"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 5}]}},
    "cameras": [{"type": "perspective", "name": "Front", "perspective": {"yfov": 0.7, "znear": 0.1}}],
    "nodes": [{"camera": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}]
  })");
  const ProgramResult result = run_program({"info", "--json", "lamp.gltf"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const nlohmann::json info = nlohmann::json::parse(result.output);
  EXPECT_EQ(info["lights"]["point"], 1);
  ASSERT_EQ(info["cameras"].size(), 1u);
  EXPECT_EQ(info["cameras"][0]["kind"], "perspective");
  EXPECT_EQ(info["extensions_unsupported"], nlohmann::json({"ACME_flying_carpet"}));
  EXPECT_EQ(info["bounds"], nullptr);
  const ProgramResult text = run_program({"info", "lamp.gltf"}, folder.path());
  EXPECT_NE(text.output.find("not honoured ACME_flying_carpet: unsupported\n"), std::string::npos) << text.output;
}

TEST(Info, ListsChoicesAndWhatPicturesLack) {
  const TemporaryFolder folder;
  write_text(folder / "shoe.gltf", R"({
    "asset": {"version": "2.0"}, "scenes": [{"name": "Shop"}, {}],
    "extensionsUsed": ["KHR_materials_variants", "KHR_xmp_json_ld"], "extensionsRequired": ["KHR_xmp_json_ld"],
    "extensions": {"KHR_materials_variants": {"variants": [{"name": "Red"}, {"name": "Blue"}]}},
    "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0},
                               {"attributes": {"POSITION": 0}, "mode": 3},
                               {"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}]}]
  })");
  const ProgramResult result = run_program({"info", "--json", "shoe.gltf"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const nlohmann::json info = nlohmann::json::parse(result.output);
  EXPECT_EQ(info["scenes"], nlohmann::json({"Shop", ""}));
  EXPECT_EQ(info["variants"], nlohmann::json({"Red", "Blue"}));
  EXPECT_EQ(info["primitives"], nlohmann::json({{"morphed", 1}, {"points", 1}, {"lines", 1}}));
  EXPECT_EQ(info["extensions_required"], nlohmann::json({"KHR_xmp_json_ld"}));
  EXPECT_TRUE(info["extensions_unsupported"].empty());
  EXPECT_EQ(info["not_honoured"][0], nlohmann::json({{"what", "KHR_xmp_json_ld"}, {"reason", "ignored: metadata"}}));
  const ProgramResult text = run_program({"info", "shoe.gltf"}, folder.path());
  for (const char* const line : {"0 'Shop', 1", "0 'Red', 1 'Blue'", "1 with morph targets, 1 of points, 1 of lines"})
    EXPECT_NE(text.output.find(line), std::string::npos) << text.output;
  const ProgramResult wrong = run_program({"info", "shoe.gltf", "--variant", "Green"}, folder.path());
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_EQ(count_errors(wrong), 1);
  EXPECT_NE(wrong.errors.find("there is no variant \"Green\"; there are: 0 \"Red\", 1 \"Blue\""), std::string::npos)
      << wrong.errors;
}

}  // namespace
}  // namespace candil::test
