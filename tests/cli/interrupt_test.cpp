/// Renders that end early: by Ctrl-C, SIGTERM, or --time. What is there is written whole.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <span>
#include <thread>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

const std::vector<std::string> endless = {"square.gltf", "--spp",      "10000000", "--size", "48x32",
                                          "--stats",     "stats.json", "-o",       "a.png"};

void expect_whole_picture(const TemporaryFolder& folder) {
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.png", "square.gltf", "stats.json"}));
  const std::string png = read_text(folder / "a.png");
  const TextureImage image = decode_texture(std::as_bytes(std::span(png)), "a.png", "test", "");
  EXPECT_EQ(image.width, 48);
  EXPECT_EQ(image.height, 32);
  const nlohmann::json stats = nlohmann::json::parse(read_text(folder / "stats.json"));
  EXPECT_GE(stats["spp"].get<int>(), 1);
  EXPECT_LT(stats["spp"].get<int>(), 10000000);
}

TEST(Interrupt, SignalsWriteWhatIsThere) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    write_square_scene(folder);
    RunningProgram program(endless, folder.path());
    ASSERT_TRUE(program.wait_for("rendering square.gltf"));
    program.send(signal);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exit_code, 130) << result.errors;
    EXPECT_NE(result.errors.find("wrote a.png (48x32, "), std::string::npos) << result.errors;
    expect_whole_picture(folder);
  }
}

// The first sample of every pixel is finished whatever happens; here it takes seconds, and the second Ctrl-C does not
// wait.
TEST(Interrupt, SecondCtrlCEndsAtOnce) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  RunningProgram program({"square.gltf", "--size", "6000x6000", "--threads", "1", "-o", "a.png"}, folder.path());
  ASSERT_TRUE(program.wait_for("rendering square.gltf"));
  program.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.signal, SIGINT) << result.exit_code << result.errors;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"square.gltf"});
}

TEST(TimeLimit, WritesWhatIsThere) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  std::vector<std::string> arguments = endless;
  arguments.insert(arguments.end(), {"--time", "0.3"});
  const ProgramResult result = run_program(arguments, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  expect_whole_picture(folder);
  const nlohmann::json stats = nlohmann::json::parse(read_text(folder / "stats.json"));
  EXPECT_EQ(stats["out_of_time"], true);
  EXPECT_GE(stats["render_seconds"].get<double>(), 0.3);
}

TEST(TimeLimit, AloneMeansAsManySamplesAsFit) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const ProgramResult result =
      run_program({"square.gltf", "--size", "4x4", "--time", "0.3", "--stats", "stats.json"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  // 16 pixels at the default of 64 samples would be done in milliseconds.
  EXPECT_GE(nlohmann::json::parse(read_text(folder / "stats.json"))["render_seconds"].get<double>(), 0.3);
}

}  // namespace
}  // namespace candil::test
