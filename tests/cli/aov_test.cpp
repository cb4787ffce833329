/// `candil render --aov`: layers in EXR files, files of their own, and what cannot be.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "tests/cli/run_program.h"
#include "tests/support/exr_channels.h"

namespace candil::test {
namespace {

ProgramResult render_square(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  write_square_scene(folder);
  arguments.insert(arguments.begin(), {"square.gltf", "--spp", "3", "--size", "32x24", "--orbit", "0,0,4"});
  return run_program(arguments, folder.path());
}

const std::vector<std::string> all_channels = {"B",         "G",         "R",           "albedo.B",   "albedo.G",
                                               "albedo.R",  "depth.Z",   "material.id", "normals.X",  "normals.Y",
                                               "normals.Z", "object.id", "position.X",  "position.Y", "position.Z",
                                               "uv.U",      "uv.V"};

constexpr std::size_t middle = 12 * 32 + 16;

// The square of 2 m faces +Z at the origin, 4 m away; outside of it is nothing.
TEST(AovCommand, ExrHasLayersBesideThePicture) {
  const TemporaryFolder folder;
  const ProgramResult plain = render_square(folder, {"-o", "plain.exr", "-o", "plain.png"});
  const ProgramResult result = render_square(folder, {"-o", "a.exr", "-o", "a.png", "--aov", "all"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.exr", "a.png", "plain.exr", "plain.png", "square.gltf"}));
  const ExrChannels exr = read_exr_channels(folder / "a.exr");
  EXPECT_EQ(exr.names(), all_channels);
  EXPECT_TRUE(exr.has_only_floats);
  EXPECT_NEAR(exr.values.at("depth.Z")[middle], 4, 1e-5f);
  EXPECT_EQ(exr.values.at("depth.Z")[0], 0);
  EXPECT_EQ(exr.values.at("normals.Z")[middle], 1);
  EXPECT_NEAR(exr.values.at("position.Z")[middle], 0, 1e-6f);
  EXPECT_EQ(exr.values.at("object.id")[middle], 0);
  EXPECT_EQ(exr.values.at("material.id")[0], -1);
  EXPECT_EQ(nlohmann::json::parse(exr.texts.at("candil:objects")).size(), 1u);
  EXPECT_TRUE(exr.texts.contains("candil:materials"));
  EXPECT_EQ(exr.texts.at("candil:spp"), "3");
  // The picture is what it is without AOVs, for candil and for other programs.
  EXPECT_EQ(read_image(folder / "a.exr").pixels, read_image(folder / "plain.exr").pixels);
  EXPECT_EQ(read_text(folder / "a.png"), read_text(folder / "plain.png"));
}

TEST(AovCommand, TransparentPicturesKeepTheirAlpha) {
  const TemporaryFolder folder;
  EXPECT_EQ(render_square(folder, {"-o", "a.exr", "--transparent", "--aov", "depth"}).exit_code, 0);
  const ExrChannels exr = read_exr_channels(folder / "a.exr");
  EXPECT_EQ(exr.names(), (std::vector<std::string>{"A", "B", "G", "R", "depth.Z"}));
  EXPECT_EQ(exr.values.at("A")[0], 0);
  EXPECT_EQ(exr.values.at("A")[middle], 1);
  EXPECT_EQ(read_image(folder / "a.exr").channels, 4);
}

TEST(AovCommand, WithoutAnExrEachHasAFileBesideTheFirstOutput) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  const ProgramResult result =
      render_square(folder, {"-o", "-", "-o", "out/a.b.png", "-o", "c.jpg", "--aov", "uv,depth,uv"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"c.jpg", "out", "square.gltf"}));
  EXPECT_EQ(read_exr_channels(folder / "out/a.b.depth.exr").names(), std::vector<std::string>{"depth.Z"});
  EXPECT_EQ(read_exr_channels(folder / "out/a.b.uv.exr").names(), (std::vector<std::string>{"uv.U", "uv.V"}));
  EXPECT_NE(result.errors.find("wrote out/a.b.depth.exr (32x24, 3 spp"), std::string::npos) << result.errors;
}

TEST(AovCommand, FilesAreNamedAfterTheSceneWhereThereIsNoOtherName) {
  const TemporaryFolder folder;
  EXPECT_EQ(render_square(folder, {"--aov", "object"}).exit_code, 0);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"square.gltf", "square.object.exr", "square.png"}));
  const TemporaryFolder other;
  EXPECT_EQ(render_square(other, {"-o", "-", "--aov", "object"}).exit_code, 0);
  EXPECT_EQ(other.names(), (std::vector<std::string>{"square.gltf", "square.object.exr"}));
}

TEST(AovCommand, SeparateFilesHoldTheSameValues) {
  const TemporaryFolder folder;
  EXPECT_EQ(render_square(folder, {"-o", "a.exr", "--aov", "depth,normals"}).exit_code, 0);
  EXPECT_EQ(render_square(folder, {"-o", "b.exr", "--aov", "depth,normals", "--aov-separate"}).exit_code, 0);
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"a.exr", "b.depth.exr", "b.exr", "b.normals.exr", "square.gltf"}));
  const ExrChannels together = read_exr_channels(folder / "a.exr");
  EXPECT_EQ(read_exr_channels(folder / "b.depth.exr").values.at("depth.Z"), together.values.at("depth.Z"));
  EXPECT_EQ(read_exr_channels(folder / "b.normals.exr").values.at("normals.X"), together.values.at("normals.X"));
  EXPECT_EQ(read_exr_channels(folder / "b.exr").names(), (std::vector<std::string>{"B", "G", "R"}));
}

// A background of one colour has no noise; the edge of the square has.
TEST(AovCommand, VarianceIsALayerOrAFile) {
  const TemporaryFolder folder;
  const std::vector<std::string> common = {"--env-color", "0.5,0.5,0.5", "--variance"};
  const auto render_with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), common.begin(), common.end());
    return render_square(folder, arguments);
  };
  EXPECT_EQ(render_with({"-o", "a.exr", "--aov", "depth"}).exit_code, 0);
  const ExrChannels exr = read_exr_channels(folder / "a.exr");
  EXPECT_EQ(exr.names(),
            (std::vector<std::string>{"B", "G", "R", "depth.Z", "variance.B", "variance.G", "variance.R"}));
  const std::vector<float>& red = exr.values.at("variance.R");
  EXPECT_EQ(red[0], 0);
  EXPECT_GT(*std::ranges::max_element(red), 1e-4f);
  EXPECT_EQ(render_with({"-o", "b.png"}).exit_code, 0);
  EXPECT_EQ(read_exr_channels(folder / "b.variance.exr").values.at("variance.R"), red);
  const ProgramResult single = render_with({"-o", "c.exr", "--spp", "1"});
  EXPECT_EQ(single.exit_code, 0);
  EXPECT_NE(single.errors.find("warning: --variance"), std::string::npos) << single.errors;
  EXPECT_EQ(render_with({"-o", "d.exr", "-o", "d.variance.exr", "--aov-separate"}).exit_code, 2);
}

TEST(AovCommand, SameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  for (const std::string threads : {"1", "2", "7"})
    EXPECT_EQ(render_square(folder, {"-o", threads + ".exr", "--aov", "all", "--threads", threads}).exit_code, 0);
  EXPECT_EQ(read_text(folder / "1.exr"), read_text(folder / "2.exr"));
  EXPECT_EQ(read_text(folder / "1.exr"), read_text(folder / "7.exr"));
}

TEST(AovCommand, StatisticsCountTheRays) {
  const TemporaryFolder folder;
  EXPECT_EQ(render_square(folder, {"--aov", "all", "--stats", "stats.json"}).exit_code, 0);
  const nlohmann::json rays = nlohmann::json::parse(read_text(folder / "stats.json")).at("rays");
  EXPECT_EQ(rays.at("camera"), 32 * 24 * 3);
  EXPECT_EQ(rays.at("aov"), 32 * 24 * 4);  // and the middles of the pixels
  EXPECT_EQ(rays.at("total"), rays.at("camera").get<int>() + rays.at("bounce").get<int>() +
                                  rays.at("shadow").get<int>() + rays.at("aov").get<int>());
}

// At a million samples, a check after the render would run into the time limit of the test.
TEST(AovCommand, UnwritableFilesGiveFourBeforeRendering) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "a.depth.exr");
  const ProgramResult result = render_square(folder, {"-o", "a.png", "--aov", "depth", "--spp", "1000000"});
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_EQ(count_errors(result), 1) << result.errors;
  EXPECT_NE(result.errors.find("a.depth.exr"), std::string::npos) << result.errors;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.depth.exr", "square.gltf"}));
}

TEST(AovCommand, NeverReplacesAnInputOrAnOutput) {
  const TemporaryFolder folder;
  write_layers(folder / "sky.depth.exr", std::vector<ImageLayer>{{"", {"R", "G", "B"}, Image(2, 1, 3)}}, {});
  const std::string sky = read_text(folder / "sky.depth.exr");
  const ProgramResult input =
      render_square(folder, {"--env", "sky.depth.exr", "-o", "sky.png", "--aov", "depth", "--env-strength", "2"});
  EXPECT_EQ(input.exit_code, 2) << input.errors;
  EXPECT_NE(input.errors.find("sky.depth.exr is a file that the scene is made of"), std::string::npos) << input.errors;
  EXPECT_EQ(read_text(folder / "sky.depth.exr"), sky);
  const ProgramResult output =
      render_square(folder, {"-o", "a.png", "-o", "./a.uv.exr", "--aov", "uv", "--aov-separate"});
  EXPECT_EQ(output.exit_code, 2) << output.errors;
  EXPECT_NE(output.errors.find("--aov: a.uv.exr is an output already"), std::string::npos) << output.errors;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"sky.depth.exr", "square.gltf"}));
}

}  // namespace
}  // namespace candil::test
