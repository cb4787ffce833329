/// JSON scenes on the command line: what the file wants, what the command line says, and exit codes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

/// A square that shines with radiance 0.25 and fills the picture.
std::filesystem::path write_lamp(const TemporaryFolder& folder, const std::string& render) {
  write_text(folder / "lamp.json", R"({
    "camera": {"look_from": [0, 0, 1], "look_at": [0, 0, 0], "fov": 40},
    "objects": [{"type": "quad", "corners": [[-5, 5, 0], [5, 5, 0], [-5, -5, 0]],
                 "material": {"type": "emitter", "emission": 0.25}}],
    "render": )" + render + "}");
  return folder / "lamp.json";
}

TEST(JsonScene, MistakesGiveThreeAndNameThePlace) {
  const TemporaryFolder folder;
  write_text(folder / "a.json", R"({"objects": [{"type": "sphere", "center": [0, 0, 0], "radius": -1}]})");
  write_text(folder / "b.json", R"({"render": {"integrator": "magic"}})");
  write_text(folder / "c.json", R"({"render": {"tonemap": "reinhard02:key=x"}})");
  for (const auto& [name, message] :
       {std::pair("a.json", "error: a.json: objects[0].radius: must be > 0\n"),
        std::pair("b.json", "error: b.json: render.integrator: 'magic' is not one of path, "),
        std::pair("c.json", "error: c.json: render.tonemap: reinhard02:key: 'x' is not a number")}) {
    const ProgramResult result = run_program({name, "-o", "a.png"}, folder.path());
    EXPECT_EQ(result.exit_code, 3) << name;
    EXPECT_EQ(count_errors(result), 1) << result.errors;
    EXPECT_NE(result.errors.find(message), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png")) << name;
  }
}

TEST(JsonScene, CommandLineGoesBeforeTheFile) {
  const TemporaryFolder folder;
  write_lamp(folder, R"({"size": [6, 4], "spp": 3, "seed": 5})");
  ASSERT_EQ(run_program({"lamp.json", "-o", "a.pfm", "--stats", "a.json"}, folder.path()).exit_code, 0);
  const nlohmann::json own = nlohmann::json::parse(read_text(folder / "a.json"));
  EXPECT_EQ(own.at("spp"), 3);
  EXPECT_EQ(own.at("seed"), 5);
  ASSERT_EQ(run_program({"lamp.json", "-o", "b.pfm", "--size", "2x3", "--spp", "1", "--stats", "b.json"}, folder.path())
                .exit_code,
            0);
  const Image a = read_image(folder / "a.pfm"), b = read_image(folder / "b.pfm");
  EXPECT_EQ(a.width, 6);
  EXPECT_EQ(a.height, 4);
  EXPECT_EQ(b.width, 2);
  EXPECT_EQ(b.height, 3);
  EXPECT_EQ(nlohmann::json::parse(read_text(folder / "b.json")).at("spp"), 1);
  for (const float value : a.pixels) EXPECT_FLOAT_EQ(value, 0.25f);
}

// Radiance 1/4, two stops brighter, without an operator: white.
TEST(JsonScene, ExposureAndOperatorOfTheFile) {
  const TemporaryFolder folder;
  write_lamp(folder, R"({"size": [2, 2], "spp": 1, "exposure": 2, "tonemap": "none"})");
  ASSERT_EQ(run_program({"lamp.json", "-o", "a.png"}, folder.path()).exit_code, 0);
  for (const float value : read_image(folder / "a.png").pixels) EXPECT_EQ(value, 1);
  ASSERT_EQ(run_program({"lamp.json", "-o", "b.png", "--exposure", "0"}, folder.path()).exit_code, 0);
  for (const float value : read_image(folder / "b.png").pixels) EXPECT_NEAR(value, 0.25f, 0.005f);
}

// A single lamp of radiance below 1 lights its scene: no studio comes in beside it.
TEST(JsonScene, EmittersKeepTheStudioOut) {
  const TemporaryFolder folder;
  write_text(folder / "dark.json", R"({
    "camera": {"look_from": [0, 0, 1], "look_at": [0, 0, 2]},
    "objects": [{"type": "quad", "corners": [[-5, 5, 0], [5, 5, 0], [-5, -5, 0]],
                 "material": {"type": "emitter", "emission": 0.5}}]})");
  ASSERT_EQ(run_program({"dark.json", "-o", "a.pfm", "--size", "2x2", "--spp", "1"}, folder.path()).exit_code, 0);
  for (const float value : read_image(folder / "a.pfm").pixels) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace candil::test
