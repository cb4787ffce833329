/// Inputs that cannot be used and outputs that cannot be written: the exit code, one line, nothing half done.
#include <gtest/gtest.h>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

void expect_failure(const ProgramResult& result, int exit_code, const std::string& message) {
  EXPECT_EQ(result.exit_code, exit_code) << result.errors;
  EXPECT_EQ(count_errors(result), 1) << result.errors;
  EXPECT_NE(result.errors.find(message), std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
}

TEST(Input, MissingFileGivesThree) {
  const TemporaryFolder folder;
  expect_failure(run_program({"missing.glb"}, folder.path()), 3, "missing.glb");
  expect_failure(run_program({"info", "missing.glb"}, folder.path()), 3, "missing.glb");
  EXPECT_TRUE(folder.names().empty());
}

TEST(Input, MalformedFileGivesThree) {
  const TemporaryFolder folder;
  write_text(folder / "broken.gltf", "{\"asset\": ");
  write_text(folder / "text.glb", "this is no scene");
  write_text(folder / "empty.gltf", "");
  std::filesystem::create_directory(folder / "folder.gltf");
  for (const char* const name : {"broken.gltf", "text.glb", "empty.gltf", "folder.gltf"}) {
    expect_failure(run_program({name, "-o", "a.png"}, folder.path()), 3, name);
    expect_failure(run_program({"info", name}, folder.path()), 3, name);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png")) << name;
  }
}

// A name may hold what a terminal would obey; the message must stay one harmless line.
TEST(Input, ControlCharactersAreNotPrinted) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"evil\x1b[2J\nerror: name.glb"}, folder.path());
  expect_failure(result, 3, "name.glb");
  EXPECT_EQ(result.errors.find('\x1b'), std::string::npos);
  EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1);
}

TEST(Input, UnusableEnvironmentGivesThree) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  write_text(folder / "sky.hdr", "no sky");
  expect_failure(run_program({"square.gltf", "--env", "missing.exr"}, folder.path()), 3, "missing.exr: no such file");
  expect_failure(run_program({"square.gltf", "--env", "sky.hdr"}, folder.path()), 3, "sky.hdr: not an HDR");
  EXPECT_FALSE(std::filesystem::exists(folder / "square.png"));
}

TEST(Output, UnwritablePlaceGivesFourBeforeRendering) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  std::filesystem::create_directory(folder / "folder.png");
  // At a million samples, a check after the render would run into the time limit of the test.
  const std::vector<std::string> common = {"square.gltf", "--spp", "1000000"};
  for (const std::string name : {"missing/a.png", "square.gltf/a.png", "folder.png"}) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"-o", "good.png", "-o", name});
    expect_failure(run_program(arguments, folder.path()), 4, name);
  }
  std::vector<std::string> with_stats = common;
  with_stats.insert(with_stats.end(), {"--stats", "missing/stats.json"});
  expect_failure(run_program(with_stats, folder.path()), 4, "missing/stats.json");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"folder.png", "square.gltf"}));
}

TEST(Output, NeverReplacesAnInput) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  std::filesystem::copy_file(folder / "square.gltf", folder / "scene.png");
  const std::string before = read_text(folder / "scene.png");
  const ProgramResult result = run_program({"scene.png", "--spp", "1", "--size", "4x4"}, folder.path());
  EXPECT_TRUE(result.exit_code == 2 || result.exit_code == 3) << result.exit_code;
  EXPECT_EQ(count_errors(result), 1) << result.errors;
  EXPECT_EQ(read_text(folder / "scene.png"), before);
}

/// Fails where `arguments` are not refused because of `file`, or change it.
void expect_survives(const TemporaryFolder& folder, std::vector<std::string> arguments, const std::string& file) {
  const std::string before = read_text(folder / file);
  arguments.insert(arguments.end(), {"--spp", "1", "--size", "4x4"});
  const ProgramResult result = run_program(arguments, folder.path());
  EXPECT_EQ(result.exit_code, 2) << file << ": " << result.errors;
  EXPECT_NE(result.errors.find(file + " is a file that the scene is made of"), std::string::npos) << result.errors;
  EXPECT_EQ(read_text(folder / file), before) << file;
}

// Whatever was read for the scene: by itself, by what it includes, and by a model in another folder.
TEST(Output, NeverReplacesAFileOfTheScene) {
  const TemporaryFolder folder;
  for (const char* const name : {"parts", "models"}) std::filesystem::create_directory(folder / name);
  write_image(folder / "studio.exr", Image(2, 1, 3), false, {});
  write_image(folder / "parts/wood.png", Image(2, 2, 3), false, {});
  write_image(folder / "models/cloth.png", Image(2, 2, 3), false, {});
  write_text(folder / "models/cloth.bin", std::string(36, '\0'));
  write_text(folder / "models/cloth.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 0}], "images": [{"uri": "cloth.png"}],
    "buffers": [{"byteLength": 36, "uri": "cloth.bin"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0],
                   "max": [0, 0, 0]}]})");
  write_text(folder / "parts/box.json", R"({"textures": {"wood": {"image": "wood.png"}}, "objects": [{"type": "sphere",
    "center": [0, 0, 0], "radius": 1, "material": {"type": "lambertian", "kd": {"texture": "wood"}}}]})");
  write_text(folder / "studio.json", R"({"include": ["parts/box.json"], "environment": {"image": "studio.exr"},
    "objects": [{"type": "gltf", "file": "models/cloth.gltf"}]})");
  for (const char* const image : {"studio.exr", "parts/wood.png", "models/cloth.png"})
    expect_survives(folder, {"studio.json", "-o", image}, image);
  for (const char* const file :
       {"studio.json", "studio.exr", "parts/box.json", "models/cloth.gltf", "models/cloth.bin"})
    expect_survives(folder, {"studio.json", "-o", "a.png", "--stats", file}, file);
  std::filesystem::copy_file(folder / "studio.exr", folder / "a.uv.exr");
  expect_survives(folder, {"parts/box.json", "--env", "a.uv.exr", "-o", "a.png", "--aov", "uv"}, "a.uv.exr");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace candil::test
