/// What `candil bench` prints and leaves behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

using Json = nlohmann::json;

/// A quick run on square.gltf.
ProgramResult run_bench(const TemporaryFolder& folder, std::vector<std::string> more) {
  write_square_scene(folder);
  std::vector<std::string> arguments = {"bench", "square.gltf", "--size", "32x16",     "--spp",
                                        "2",     "--repeat",    "2",      "--threads", "1,2"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments, folder.path());
}

TEST(Bench, PrintsTables) {
  const TemporaryFolder folder;
  const ProgramResult result = run_bench(folder, {"--accel", "embree", "--accel", "embree:robust=off"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  for (const char* const part :
       {"square.gltf: 2 triangles", "32x16 at 2 spp", "Build", "1 thread", "2 threads", "memory", "Mrays/s, 1 thread",
        "primary", "first bounce", "deeper bounces", "shadow", "x1.00", "bare Embree", "embree:robust=off: ",
        " answers compared with those of embree, ", " 0 wrong", "processors", "candil " CANDIL_VERSION})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << "\n" << result.output;
  EXPECT_NE(result.errors.find("square.gltf: replaying, 2 of 2\n"), std::string::npos) << result.errors;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"square.gltf"});
}

TEST(Bench, IsQuietWhenAsked) {
  const TemporaryFolder folder;
  const ProgramResult result = run_bench(folder, {"--quiet"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "");
  EXPECT_NE(result.output.find("Mrays/s"), std::string::npos);
}

void expect_spread(const Json& spread) {
  EXPECT_GT(spread.at("min").get<double>(), 0);
  EXPECT_LE(spread.at("min").get<double>(), spread.at("median").get<double>());
  EXPECT_LE(spread.at("median").get<double>(), spread.at("max").get<double>());
}

TEST(Bench, WritesJson) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_bench(folder, {"--accel", "embree", "--accel", "embree:quality=low", "--json", "bench.json"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const Json json = Json::parse(read_text(folder / "bench.json"));
  EXPECT_EQ(json.at("versions").at("candil"), CANDIL_VERSION);
  EXPECT_FALSE(json.at("machine").at("processor").get<std::string>().empty());
  EXPECT_GE(json.at("machine").at("hardware_threads").get<int>(), 1);
  EXPECT_EQ(json.at("settings").at("width"), 32);
  EXPECT_EQ(json.at("settings").at("threads"), Json({1, 2}));
  ASSERT_EQ(json.at("scenes").size(), 1u);
  const Json& scene = json.at("scenes")[0];
  EXPECT_EQ(scene.at("file"), "square.gltf");
  EXPECT_EQ(scene.at("scene").at("triangles"), 2);
  EXPECT_EQ(scene.at("paths"), 32 * 16 * 2);
  EXPECT_EQ(scene.at("paths_left_out"), 0);
  EXPECT_EQ(scene.at("rays").at("primary"), 32 * 16 * 2);
  std::size_t rays = 0;
  for (const auto& [kind, count] : scene.at("rays").items()) rays += count.get<std::size_t>();
  EXPECT_EQ(scene.at("recorded_bytes"), 28 * rays);  // seven floats each
  ASSERT_EQ(scene.at("contestants").size(), 2u);
  EXPECT_EQ(scene.at("contestants")[1].at("name"), "embree:quality=low");
  for (const Json& contestant : scene.at("contestants")) {
    EXPECT_GT(contestant.at("memory_bytes").get<int>(), 0);
    EXPECT_EQ(contestant.at("bytes_per_primitive").get<double>() * 2, contestant.at("memory_bytes").get<double>());
    EXPECT_TRUE(contestant.at("bytes_per_instance").is_null());
    ASSERT_EQ(contestant.at("build").size(), 2u);
    EXPECT_EQ(contestant.at("build")[1].at("threads"), 2);
    expect_spread(contestant.at("build")[1].at("seconds"));
    ASSERT_EQ(contestant.at("rates").size(), 2u);
    EXPECT_EQ(contestant.at("rates")[1].at("threads"), 2);
    const Json& primary = contestant.at("rates")[1].at("primary");
    EXPECT_EQ(primary.at("rays"), 32 * 16 * 2);
    expect_spread(primary.at("rays_per_second"));
    expect_spread(primary.at("ratio"));
    EXPECT_EQ(contestant.at("agreement").at("shadow").at("mismatches"), 0);
  }
  EXPECT_EQ(scene.at("contestants")[1].at("agreement").at("primary").at("rays"), 32 * 16 * 2);
  EXPECT_EQ(scene.at("bare_embree").size(), 2u);
  expect_spread(scene.at("renderer")[0].at("rays_per_second"));
  expect_spread(scene.at("renderer")[0].at("share"));
}

TEST(Bench, WritesJsonAloneToStandardOutput) {
  const TemporaryFolder folder;
  const ProgramResult result = run_bench(folder, {"--json", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(Json::parse(result.output).at("scenes").size(), 1u);
}

TEST(Bench, SaysWhatDidNotFit) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  // 65536 camera rays of 28 bytes are more than a megabyte.
  const ProgramResult result = run_program(
      {"bench", "square.gltf", "--size", "256x256", "--spp", "1", "--repeat", "1", "--threads", "1", "--memory", "1"},
      folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find(" of 65,536 paths did not fit into the 1 MB of --memory"), std::string::npos)
      << result.output;
}

TEST(Bench, DrawsAnSvg) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_bench(folder, {"--accel", "embree", "--accel", "embree:robust=off", "--plot", "a.svg"});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const std::string svg = read_text(folder / "a.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\"")) << svg;
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  for (const char* const text : {">square.gltf<", ">embree:robust=off<", ">deeper bounces<", "with 2 threads"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

TEST(Bench, DrawsAPng) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_bench(folder, {"--plot", "a.png"}).exit_code, 0);
  const Image image = read_image(folder / "a.png");
  EXPECT_GT(image.width, 400);
  EXPECT_GT(image.height, 400);
  // White paper with black letters and bars of one colour, #0072b2.
  const float* const corner = image.pixel(0, 0);
  EXPECT_NEAR(corner[0] + corner[1] + corner[2], 3, 1e-4);
  int black = 0, blue = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float* const p = image.pixel(x, y);
      black += p[0] + p[1] + p[2] < 1e-4f;
      blue += p[0] < 1e-4f && p[2] > 0.4f;
    }
  }
  EXPECT_GT(black, 1000);
  EXPECT_GT(blue, 2000);
}

TEST(Bench, NeverReplacesAScene) {
  const TemporaryFolder folder;
  const std::string before = read_text(write_square_scene(folder));
  const ProgramResult result = run_bench(folder, {"--json", "square.gltf"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find("--json: square.gltf is a file that a scene is made of"), std::string::npos)
      << result.errors;
  EXPECT_EQ(read_text(folder / "square.gltf"), before);
}

TEST(Bench, FailsBeforeTheWorkWhenAnOutputCannotBeWritten) {
  const TemporaryFolder folder;
  const ProgramResult result = run_bench(folder, {"--json", "no/such/folder.json"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(count_errors(result), 1);
  EXPECT_EQ(result.output, "");
}

TEST(Bench, NamesAMissingScene) {
  const TemporaryFolder folder;
  const ProgramResult result = run_bench(folder, {"missing.glb"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.errors.find("missing.glb"), std::string::npos);
}

}  // namespace
}  // namespace candil::test
