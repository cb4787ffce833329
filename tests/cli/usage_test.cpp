/// Wrong command lines: exit code 2, one line that names the option, and no file touched.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <regex>

#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

struct WrongUsage {
  std::vector<std::string> arguments;
  std::string message;  ///< Part of the line.
};

void PrintTo(const WrongUsage& usage, std::ostream* stream) {
  for (const std::string& word : usage.arguments) *stream << word << ' ';
}

class Usage : public testing::TestWithParam<WrongUsage> {};

TEST_P(Usage, IsRefusedInOneLine) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const ProgramResult result = run_program(GetParam().arguments, folder.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.errors.find(GetParam().message), std::string::npos) << result.errors;
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << result.errors;
  EXPECT_EQ(count_errors(result), 1) << result.errors;
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"square.gltf"});
}

const std::vector<WrongUsage> wrong_usages = {
    {{}, "no scene given"},
    {{"render"}, "SCENE"},
    {{"info"}, "SCENE"},
    {{"--list-extensions", "info", "square.gltf"}, "--list-extensions goes with no command"},
    {{"info", "square.gltf", "--list-extensions"}, "--list-extensions"},
    {{"square.gltf", "extra"}, "extra"},
    {{"square.gltf", "--no-such-option"}, "--no-such-option"},
    {{"info", "square.gltf", "--spp", "3"}, "--spp"},
    {{"square.gltf", "--spp"}, "--spp"},
    {{"square.gltf", "--spp", "0"}, "--spp: '0' is not a whole number from 1"},
    {{"square.gltf", "--spp", "-4"}, "--spp: '-4'"},
    {{"square.gltf", "--spp", "4.5"}, "--spp: '4.5'"},
    {{"square.gltf", "--spp", "99999999999999999999"}, "--spp"},
    {{"square.gltf", "--size", "64"}, "--size: '64'"},
    {{"square.gltf", "--size", "0x64"}, "--size: '0x64'"},
    {{"square.gltf", "--size", "64x64x64"}, "--size"},
    {{"square.gltf", "--size", "100000x1"}, "--size"},
    {{"square.gltf", "--look-from", "0,0,1e10"}, "--look-from: 1e10 is not between -1e+09 and 1e+09"},
    {{"square.gltf", "--look-from", "0,0,1", "--look-at", "0,-1e19,0"}, "--look-at: -1e19 is not between"},
    {{"square.gltf", "--orbit", "0,0,1e20"}, "--orbit: 1e20 is not between"},
    {{"square.gltf", "--max-bounces", "many"}, "--max-bounces"},
    {{"square.gltf", "--filter", "triangle"}, "--filter: 'triangle' is not one of blackman-harris, box, gaussian"},
    {{"square.gltf", "--experimental", "magic"}, "--experimental: 'magic' is not one of volume-scatter"},
    {{"square.gltf", "--accel", "octree"}, "--accel: 'octree' is not one of embree, report, sah, wide, brute"},
    {{"square.gltf", "--accel", "sah:robust=on"}, "--accel: 'robust' is not one of quality"},
    {{"square.gltf", "--accel", "brute:quality=low"}, "--accel: brute has no options"},
    {{"square.gltf", "--accel", "embree:speed=high"}, "--accel: 'speed' is not one of quality, robust, "},
    {{"square.gltf", "--accel", "embree:quality"}, "--accel: quality: '' is not one of low, medium, high"},
    {{"square.gltf", "--accel", "embree:isa=6502"}, "--accel: isa: '6502' is not one of sse2, "},
    {{"square.gltf", "--integrator", "Path"},
     "--integrator: 'Path' is not one of path, naive, classic, normals, albedo"},
    {{"square.gltf", "--tonemap", "aces?"}, "--tonemap: 'aces?' is not one of neutral, aces, agx, reinhard02, "},
    {{"square.gltf", "--tonemap", "aces:key=1"}, "--tonemap: aces takes no parameters, not 'key'"},
    {{"square.gltf", "--tonemap", "reinhard02:gamma=1"},
     "--tonemap: 'gamma' is not a parameter of reinhard02, which takes key, white"},
    {{"square.gltf", "--tonemap", "reinhard02:key"}, "--tonemap: reinhard02:key: '' is not a number"},
    {{"square.gltf", "--tonemap", "reinhard02:"}, "--tonemap: '' is not a parameter of reinhard02"},
    {{"square.gltf", "--tonemap", "gamma:gamma=2,white=nan"}, "--tonemap: gamma:white: 'nan' is not a number"},
    {{"square.gltf", "--aov", "normals,Depth"},
     "--aov: 'Depth' is not one of normals, depth, albedo, position, uv, material, object, all"},
    {{"square.gltf", "--aov", ""}, "--aov"},
    {{"square.gltf", "--aov", "depth,"}, "--aov: '' is not one of normals, "},
    {{"square.gltf", "--aov-separate"}, "--aov"},
    {{"square.gltf", "--ppm", "P3"}, "--ppm: 'P3' is not one of binary, ascii, hdr"},
    {{"bench"}, "SCENE"},
    {{"bench", "square.gltf", "--accel", "octree"}, "--accel: 'octree' is not one of embree"},
    {{"bench", "square.gltf", "--accel", "embree", "--accel", "embree:isa=6502"}, "--accel: isa: '6502' is not one of"},
    {{"bench", "square.gltf", "--threads", "1,0"}, "--threads: '0' is not a whole number from 1 to 1024"},
    {{"bench", "square.gltf", "--threads", ""}, "--threads"},
    {{"bench", "square.gltf", "--threads", "1,2,3,4,5,6,7,8,9"}, "--threads: more than 8 numbers"},
    {{"bench", "square.gltf", "--repeat", "0"}, "--repeat: '0'"},
    {{"bench", "square.gltf", "--memory", "0"}, "--memory: '0' is not a whole number from 1"},
    {{"bench", "square.gltf", "--memory", "99999999999"}, "--memory"},
    {{"bench", "square.gltf", "--limit", "0"}, "--limit: 0 is not between"},
    {{"bench", "square.gltf", "--size", "0x0"}, "--size: '0x0'"},
    {{"bench", "square.gltf", "--spp", "0"}, "--spp: '0'"},
    {{"bench", "square.gltf", "--plot", "bench.pdf"}, "--plot: bench.pdf: unknown format; use .svg or .png"},
    {{"bench", "square.gltf", "--exposure", "1"}, "--exposure"},
    {{"tonemap"}, "INPUT"},
    {{"tonemap", "square.gltf", "--spp", "4"}, "--spp"},
    {{"tonemap", "square.gltf", "-o", "a.gif"}, "a.gif: unknown format"},
    {{"tonemap", "square.gltf", "--operator", "ACES"}, "--operator: 'ACES' is not one of neutral, aces, "},
    {{"tonemap", "square.gltf", "--tonemap", "gamma:gamma=0"}, "gamma:gamma: 0 is not between 0.1 and 10"},
    {{"tonemap", "square.gltf", "--operator", "equalize-clamp:share=1.01"}, "share: 1.01 is not between"},
    {{"tonemap", "square.gltf", "--operator", "reinhard05:intensity=9"}, "intensity: 9 is not between -8 and 8"},
    {{"tonemap", "square.gltf", "--exposure", "100"}, "--exposure: 100 is not between -64 and 64"},
    {{"square.gltf", "--seed", "-1"}, "--seed"},
    {{"square.gltf", "--threads", "0"}, "--threads"},
    {{"square.gltf", "--time", "0"}, "--time"},
    {{"square.gltf", "--time", "nan"}, "--time: 'nan' is not a number"},
    {{"square.gltf", "--exposure", "inf"}, "--exposure: 'inf' is not a number"},
    {{"square.gltf", "--env-color", "1,2"}, "--env-color: '1,2' is not 3 numbers"},
    {{"square.gltf", "--env-color", "1,-2,1"}, "--env-color: light must not be negative"},
    {{"square.gltf", "--env-color", "1,nan,1"}, "--env-color"},
    {{"square.gltf", "--env-strength", "-1"}, "--env-strength"},
    {{"square.gltf", "--env", "a.hdr", "--env-color", "1,1,1"}, "--env"},
    {{"square.gltf", "--camera", "0"}, "--camera: no camera '0'; the scene has no cameras"},
    {{"square.gltf", "--camera", "0", "--orbit", "0,0"}, "--camera"},
    {{"square.gltf", "--look-at", "0,0,0"}, "--look-from"},
    {{"square.gltf", "--look-from", "1;2;3"}, "--look-from"},
    {{"square.gltf", "--orbit", "1"}, "--orbit: '1' is not 2 to 3 numbers"},
    {{"square.gltf", "--orbit", "1,2,-3"}, "--orbit: the distance must be positive"},
    {{"square.gltf", "--fov", "180"}, "--fov: 180 is not between"},
    {{"square.gltf", "--aperture", "-1"}, "--aperture"},
    {{"square.gltf", "--focus", "0"}, "--focus"},
    {{"square.gltf", "-o", "picture.gif"}, "picture.gif: unknown format"},
    {{"square.gltf", "-o", "picture"}, "picture: unknown format"},
    {{"square.gltf", "-o", "-", "-o", "-"}, "only once"},
};

INSTANTIATE_TEST_SUITE_P(CommandLine, Usage, testing::ValuesIn(wrong_usages));

TEST(Help, IsPrintedForEveryCommandWithExamples) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"render", "--help"},
                                                    {"tonemap", "--help"},
                                                    {"compare", "--help"},
                                                    {"info", "--help"},
                                                    {"bench", "--help"},
                                                    {"-h"}}) {
    const ProgramResult result = run_program(arguments, folder.path());
    EXPECT_EQ(result.exit_code, 0) << arguments[0];
    EXPECT_NE(result.output.find("Examples:"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("candil"), std::string::npos) << result.output;
    EXPECT_EQ(result.errors, "");
  }
}

TEST(Help, ListsTheOptionsOfRender) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"render", "--help"}, folder.path());
  for (const char* const option :
       {"--output",    "--spp",    "--size",        "--max-bounces",  "--filter",     "--seed",
        "--threads",   "--time",   "--integrator",  "--env",          "--env-rotate", "--env-strength",
        "--env-color", "--camera", "--orbit",       "--look-from",    "--look-at",    "--fov",
        "--aperture",  "--focus",  "--transparent", "--exposure",     "--tonemap",    "--ppm",
        "--stats",     "--quiet",  "--aov",         "--aov-separate", "--variance"})
    EXPECT_NE(result.output.find(option), std::string::npos) << option;
}

TEST(Help, ListsTheOptionsOfBench) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"bench", "--help"}, folder.path());
  for (const char* const option : {"SCENE", "--accel", "--threads", "--spp", "--size", "--repeat", "--memory",
                                   "--limit", "--json", "--plot", "--quiet"})
    EXPECT_NE(result.output.find(option), std::string::npos) << option;
}

TEST(Help, ListsTheOperatorsOfTonemapWithTheirParameters) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"tonemap", "--help"}, folder.path());
  for (const char* const word :
       {"neutral", "aces", "agx", "reinhard02", "reinhard05", "clamp", "equalize", "equalize-clamp", "clamp-gamma",
        "none", "(default 0.18, ", "(default 0.78, ", "(default 0.86, ", "(default 2.2, ", "sRGB", "--ppm"})
    EXPECT_NE(result.output.find(word), std::string::npos) << word;
}

TEST(Help, ListsTheExitCodes) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"--help"}, folder.path());
  EXPECT_NE(result.output.find("Exit codes: 0 done"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("130 interrupted"), std::string::npos) << result.output;
}

TEST(Extensions, AreListedWithTheirTiers) {
  const TemporaryFolder folder;
  const ProgramResult text = run_program({"--list-extensions"}, folder.path());
  EXPECT_EQ(text.exit_code, 0) << text.errors;
  EXPECT_EQ(text.errors, "");
  EXPECT_TRUE(std::regex_search(text.output, std::regex("\nKHR_texture_transform +full\n"))) << text.output;
  EXPECT_TRUE(std::regex_search(text.output, std::regex("\nKHR_xmp_json_ld +ignored +metadata\n"))) << text.output;
  const ProgramResult json = run_program({"--list-extensions", "--json"}, folder.path());
  EXPECT_EQ(json.exit_code, 0) << json.errors;
  const nlohmann::json list = nlohmann::json::parse(json.output).at("extensions");
  const auto transform =
      std::find_if(list.begin(), list.end(), [](const auto& row) { return row.at("name") == "KHR_texture_transform"; });
  ASSERT_NE(transform, list.end());
  EXPECT_EQ(transform->at("tier"), "full");
  EXPECT_EQ(transform->at("is_honoured"), true);
  EXPECT_TRUE(folder.names().empty());
}

TEST(Version, NamesTheLibraries) {
  const TemporaryFolder folder;
  const ProgramResult result = run_program({"--version"}, folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.output.starts_with("candil " CANDIL_VERSION ", Embree ")) << result.output;
  EXPECT_NE(result.output.find(", OpenImageIO "), std::string::npos) << result.output;
  EXPECT_EQ(result.errors, "");
}

}  // namespace
}  // namespace candil::test
