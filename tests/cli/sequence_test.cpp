/// `--animation`, `--at` and `--frames`: frames are the stills of their times, byte for byte, and a sequence can be
/// stopped.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

/// A square that rises by 1 m within a second, "rise", and one that stays, "stay".
void write_rising_square(const TemporaryFolder& folder) {
  std::string text = read_text(write_square_scene(folder));
  // Times 0 and 1, then (0 0 0) and (0 1 0).
  const std::string keys = "AAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAACAPwAAAAA=";
  const auto insert_into = [&](const std::string& array, const std::string& elements) {
    // Every array of the scene that gets more has its ']' before the next member or the end.
    const std::size_t begin = text.find("\"" + array + "\": [");
    const std::size_t end = text.find("}]", begin) + 1;
    text.insert(end, ", " + elements);
  };
  insert_into("buffers", R"({"byteLength": 32, "uri": "data:application/octet-stream;base64,)" + keys + "\"}");
  insert_into("bufferViews", R"({"buffer": 1, "byteLength": 8}, {"buffer": 1, "byteOffset": 8, "byteLength": 24})");
  insert_into("accessors", R"({"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                              {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"})");
  const auto animation = [](const std::string& name, const std::string& path) {
    return R"({"name": ")" + name + R"(", "samplers": [{"input": 2, "output": 3}],
               "channels": [{"sampler": 0, "target": {"node": 0, "path": ")" +
           path + "\"}}]}";
  };
  text.insert(text.find("\"scene\""), "\"animations\": [" + animation("rise", "translation") + "], ");
  write_text(folder / "square.gltf", text);
}

ProgramResult render(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"square.gltf", "--spp", "2", "--size", "24x16"});
  return run_program(arguments, folder.path());
}

TEST(Sequence, FramesAreTheStillsOfTheirTimes) {
  const TemporaryFolder folder;
  write_rising_square(folder);
  const ProgramResult result = render(folder, {"--frames", "3-5", "--fps", "10", "-o", "f_{:03}.png", "-o", "%d.exr"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"3.exr", "4.exr", "5.exr", "f_003.png", "f_004.png", "f_005.png",
                                                      "square.gltf"}));
  for (const std::string frame : {"3", "4", "5"}) {
    const ProgramResult still = render(folder, {"--at", "0." + frame, "-o", "still.exr", "-o", "still.png"});
    EXPECT_EQ(still.exit_code, 0) << still.errors;
    EXPECT_EQ(read_text(folder / "still.exr"), read_text(folder / (frame + ".exr"))) << frame;
    EXPECT_EQ(read_text(folder / "still.png"), read_text(folder / ("f_00" + frame + ".png"))) << frame;
  }
  EXPECT_NE(read_text(folder / "3.exr"), read_text(folder / "5.exr"));
}

// A colour that changes moves nothing: the hierarchy of the first frame serves the second one, which still has the bits
// of a still.
TEST(Sequence, HierarchiesOfWhatStandsStillAreKept) {
  const TemporaryFolder folder;
  write_rising_square(folder);
  std::string text = read_text(folder / "square.gltf");
  const std::string target = R"({"node": 0, "path": "translation"})";
  text.replace(text.find(target), target.size(), R"({"path": "pointer", "extensions": {"KHR_animation_pointer":
      {"pointer": "/materials/0/emissiveFactor"}}})");
  write_text(folder / "square.gltf", text);
  const ProgramResult result = render(folder, {"--frames", "0-1", "--fps", "2", "-o", "{}.exr", "--stats", "{}.json"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_GT(nlohmann::json::parse(read_text(folder / "0.json"))["bvh_seconds"].get<double>(), 0);
  EXPECT_EQ(nlohmann::json::parse(read_text(folder / "1.json"))["bvh_seconds"].get<double>(), 0);
  EXPECT_EQ(render(folder, {"--at", "0.5", "-o", "still.exr"}).exit_code, 0);
  EXPECT_EQ(read_text(folder / "still.exr"), read_text(folder / "1.exr"));
  EXPECT_NE(read_text(folder / "0.exr"), read_text(folder / "1.exr"));
}

TEST(Sequence, NamesWithoutAPlaceForTheNumberGetOne) {
  const TemporaryFolder folder;
  write_rising_square(folder);
  EXPECT_EQ(render(folder, {"--frames", "7"}).exit_code, 0);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"square.gltf", "square_0007.png"}));
}

TEST(Sequence, AutomaticCamerasFrameTheWholeMotion) {
  const TemporaryFolder folder;
  write_rising_square(folder);
  // The square is as high in the last frame as it is low in the first one: both differ from the rest pose's own frame,
  // which a still without time has.
  EXPECT_EQ(render(folder, {"--at", "0", "-o", "at.png"}).exit_code, 0);
  EXPECT_EQ(render(folder, {"-o", "rest.png"}).exit_code, 0);
  EXPECT_NE(read_text(folder / "at.png"), read_text(folder / "rest.png"));
  EXPECT_EQ(render(folder, {"--at", "0", "--look-from", "0,0,5", "--look-at", "0,0,0", "-o", "at.png"}).exit_code, 0);
  EXPECT_EQ(render(folder, {"--look-from", "0,0,5", "--look-at", "0,0,0", "-o", "rest.png"}).exit_code, 0);
  EXPECT_EQ(read_text(folder / "at.png"), read_text(folder / "rest.png"));
}

TEST(Sequence, WrongUsageIsToldBeforeTheSceneIsRead) {
  const TemporaryFolder folder;
  const auto error = [&](std::vector<std::string> arguments) {
    const ProgramResult result = render(folder, std::move(arguments));
    EXPECT_EQ(result.exit_code, 2) << result.errors;
    return result.errors;
  };
  EXPECT_NE(error({"--frames", "5-3"}).find("--frames: the last frame comes before the first one"), std::string::npos);
  EXPECT_NE(error({"--frames", "1-2-3"}).find("is no range of frames"), std::string::npos);
  EXPECT_NE(error({"--frames", "1-2", "-o", "{}_{}.png"}).find("two places"), std::string::npos);
  EXPECT_NE(error({"--frames", "1-2", "-o", "-"}).find("one picture"), std::string::npos);
  EXPECT_NE(error({"--frames", "1-2", "--at", "1"}).find("--at is a still"), std::string::npos);
  EXPECT_NE(error({"--fps", "30"}).find("--fps needs --frames"), std::string::npos);
  EXPECT_NE(error({"--frames", "1-2", "--fps", "0"}).find("--fps"), std::string::npos);
}

TEST(Sequence, FilesWithoutAnimationsAreRefused) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const ProgramResult sequence = render(folder, {"--frames", "1-2"}), still = render(folder, {"--at", "1"});
  EXPECT_EQ(sequence.exit_code, 3) << sequence.errors;
  EXPECT_EQ(still.exit_code, 3) << still.errors;
  EXPECT_NE(still.errors.find("animations: there is no animation \"0\", the file has none"), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"square.gltf"});
}

// Frames that were finished stay, the one under way is not written.
TEST(Sequence, CtrlCEndsBetweenFrames) {
  const TemporaryFolder folder;
  write_rising_square(folder);
  RunningProgram program({"square.gltf", "--spp", "16", "--size", "64x64", "--frames", "0-999999", "-o", "{}.png"},
                         folder.path());
  ASSERT_TRUE(program.wait_for("wrote 1.png"));
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 130) << result.errors;
  EXPECT_NE(result.errors.find("stopped before frame "), std::string::npos) << result.errors;
  for (const std::string& name : folder.names()) {
    if (name == "square.gltf") continue;
    EXPECT_TRUE(name.ends_with(".png") && !name.starts_with(".")) << name;
    EXPECT_TRUE(result.errors.find("wrote " + name + " (64x64, 16 spp") != std::string::npos) << name;
  }
}

TEST(Sequence, InfoListsAnimations) {
  const TemporaryFolder folder;
  write_rising_square(folder);
  const ProgramResult text = run_program({"info", "square.gltf"}, folder.path());
  EXPECT_NE(text.output.find("rise"), std::string::npos) << text.output;
  const ProgramResult json = run_program({"info", "--json", "square.gltf"}, folder.path());
  EXPECT_NE(json.output.find("\"animations\""), std::string::npos) << json.output;
}

}  // namespace
}  // namespace candil::test
