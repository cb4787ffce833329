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
  for (const char* const text : {"square.gltf", "2 (2 with instances)", "2 x 2 x 0 m", "cameras     0", "0 point"})
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
  EXPECT_NE(text.output.find("ACME_flying_carpet"), std::string::npos) << text.output;
}

}  // namespace
}  // namespace candil::test
