/// What `candil render` leaves behind: pictures in every format, statistics, and the same bytes every time.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <span>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

TextureImage decode(const std::string& bytes) {
  return decode_texture(std::as_bytes(std::span(bytes)), "picture", "test", "");
}

ProgramResult render_square(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  write_square_scene(folder);
  arguments.insert(arguments.begin(), {"square.gltf", "--spp", "4", "--size", "32x24"});
  const ProgramResult result = run_program(arguments, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return result;
}

TEST(Render, WithoutOptionsWritesAPngNamedAfterTheScene) {
  const TemporaryFolder folder;
  const ProgramResult result = render_square(folder, {});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"square.gltf", "square.png"}));
  EXPECT_NE(result.errors.find("wrote square.png (32x24, 4 spp, "), std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
  const TextureImage image = decode(read_text(folder / "square.png"));
  EXPECT_EQ(image.width, 32);
  EXPECT_EQ(image.height, 24);
  EXPECT_FALSE(image.has_alpha);
  // The studio lights the square, which fills the middle of the frame: it is brighter in red than in blue.
  const glm::u8vec4 middle = image.rgba8[12 * 32 + 16];
  EXPECT_GT(middle.x, middle.z + 20);
}

TEST(Render, NamedAndUnnamedCommandAreTheSame) {
  const TemporaryFolder folder;
  render_square(folder, {"-o", "a.png"});
  const ProgramResult named =
      run_program({"render", "--spp", "4", "--size", "32x24", "square.gltf", "-o", "b.png"}, folder.path());
  EXPECT_EQ(named.exit_code, 0) << named.errors;
  EXPECT_EQ(read_text(folder / "a.png"), read_text(folder / "b.png"));
}

TEST(Render, WritesSeveralFormatsAtOnce) {
  const TemporaryFolder folder;
  render_square(folder, {"-o", "a.png", "-o", "a.exr", "-o", "a.jpg", "-o", "a.hdr", "-o", "a.pfm", "-o", "a.tif"});
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"a.exr", "a.hdr", "a.jpg", "a.pfm", "a.png", "a.tif", "square.gltf"}));
  EXPECT_EQ(decode(read_text(folder / "a.jpg")).width, 32);
  // EXR and PFM hold the same floats.
  EXPECT_EQ(read_environment(folder / "a.exr").pixels, read_environment(folder / "a.pfm").pixels);
}

TEST(Render, DashWritesThePngToStandardOutput) {
  const TemporaryFolder folder;
  const ProgramResult result = render_square(folder, {"-o", "-", "-o", "same.png"});
  EXPECT_EQ(result.output, read_text(folder / "same.png"));
  EXPECT_EQ(decode(result.output).height, 24);
}

TEST(Render, QuietSaysNothing) {
  const TemporaryFolder folder;
  const ProgramResult result = render_square(folder, {"--quiet"});
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(result.output, "");
  EXPECT_TRUE(std::filesystem::exists(folder / "square.png"));
}

TEST(Render, LogsAreLinesWithoutTerminalCodes) {
  const TemporaryFolder folder;
  const ProgramResult result = render_square(folder, {});
  EXPECT_NE(result.errors.find("rendering square.gltf: 32x24, 4 spp"), std::string::npos) << result.errors;
  EXPECT_EQ(result.errors.find('\r'), std::string::npos);
  EXPECT_EQ(result.errors.find('\x1b'), std::string::npos);
}

TEST(Render, TransparentBackgroundHasAlphaAndOpaqueHasNot) {
  const TemporaryFolder folder;
  render_square(folder, {"--transparent", "--orbit", "0,0,20", "--filter", "box"});
  const TextureImage image = decode(read_text(folder / "square.png"));
  ASSERT_TRUE(image.has_alpha);
  // From 20 m the square of 2 m covers the middle only.
  EXPECT_EQ(image.rgba8[0].w, 0);
  EXPECT_EQ(image.rgba8[12 * 32 + 16].w, 255);
}

TEST(Render, TransparencyWithoutAlphaIsWarnedOf) {
  const TemporaryFolder folder;
  const ProgramResult result = render_square(folder, {"--transparent", "--quiet", "-o", "a.png", "-o", "b.jpg"});
  EXPECT_EQ(result.errors, "warning: b.jpg: the format has no alpha, the background will be black\n");
}

// The square faces +Z: its normal (0, 0, 1) is the colour (0.5, 0.5, 1), and 0.5 is 188 in sRGB. No operator bends
// that.
TEST(Render, NormalsAreNotToneMapped) {
  const TemporaryFolder folder;
  render_square(folder, {"--integrator", "normals", "--orbit", "0,0"});
  const glm::u8vec4 middle = decode(read_text(folder / "square.png")).rgba8[12 * 32 + 16];
  EXPECT_EQ(middle.x, 188);
  EXPECT_EQ(middle.y, 188);
  EXPECT_EQ(middle.z, 255);
}

// One stop doubles linear light; linear outputs stay as they are.
TEST(Render, ExposureIsForDisplaysOnly) {
  const TemporaryFolder folder;
  const std::vector<std::string> light = {"--env-color", "0.1,0.1,0.1", "--tonemap", "none"};
  std::vector<std::string> plain = light, brighter = light;
  plain.insert(plain.end(), {"-o", "a.png", "-o", "a.exr"});
  brighter.insert(brighter.end(), {"--exposure", "1", "-o", "b.png", "-o", "b.exr"});
  render_square(folder, plain);
  render_square(folder, brighter);
  EXPECT_EQ(read_environment(folder / "a.exr").pixels, read_environment(folder / "b.exr").pixels);
  // The corner shows the environment: 0.1 and 0.2, 8 bits of the sRGB curve.
  const Image dark = read_environment(folder / "a.png"), bright = read_environment(folder / "b.png");
  EXPECT_NEAR(dark.pixels[0], 0.1f, 0.002f);
  EXPECT_NEAR(bright.pixels[0], 0.2f, 0.004f);
}

TEST(Render, EnvironmentOptionsReachThePicture) {
  const TemporaryFolder folder;
  Image sky(8, 4, 3);
  for (std::size_t i = 0; i < sky.pixels.size(); ++i) sky.pixels[i] = i % 3 == 0 ? 0.5f : 0.25f;
  write_image(folder / "sky.exr", sky, false, {});
  render_square(folder, {"--env", "sky.exr", "--env-strength", "3", "--env-rotate", "40", "-o", "a.exr"});
  const Image picture = read_environment(folder / "a.exr");
  EXPECT_NEAR(picture.pixels[0], 1.5f, 1e-5f);
  EXPECT_NEAR(picture.pixels[1], 0.75f, 1e-5f);
}

TEST(Render, SaysThatASceneHasNothingToShow) {
  const TemporaryFolder folder;
  write_text(folder / "empty.gltf", R"({"asset":{"version":"2.0"}})");
  const ProgramResult result = run_program({"empty.gltf", "--size", "8x8", "--spp", "1", "-q"}, folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.errors, "warning: empty.gltf: no surface is in the scene, the picture shows the background\n");
}

TEST(Render, BlackEnvironmentMeansNoLight) {
  const TemporaryFolder folder;
  const ProgramResult result = render_square(folder, {"--env-color", "0,0,0", "-o", "a.exr"});
  EXPECT_NE(result.errors.find("warning: square.gltf: no light"), std::string::npos) << result.errors;
  for (const float value : read_environment(folder / "a.exr").pixels) EXPECT_EQ(value, 0.0f);
}

/// The scene of the square with a white glow of this strength.
void write_glowing_square(const TemporaryFolder& folder, const std::string& strength) {
  std::string scene = read_text(write_square_scene(folder));
  scene.insert(scene.find("\"doubleSided\""),
               R"("emissiveFactor": [1, 1, 1],
                  "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": )" +
                   strength + "}}, ");
  scene.insert(scene.find("\"scene\""), R"("extensionsUsed": ["KHR_materials_emissive_strength"], )");
  write_text(folder / "lamp.gltf", scene);
}

// Up to the white of the screen a surface only glows and the studio lights the scene; brighter ones are lamps and keep
// it away.
TEST(Render, StudioLightsScenesThatOnlyGlow) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {"lamp.gltf", "--spp",  "1",  "--size", "8x8",
                                              "--orbit",   "0,0,20", "-o", "a.exr"};
  write_glowing_square(folder, "1");
  EXPECT_EQ(run_program(arguments, folder.path()).exit_code, 0);
  EXPECT_GT(read_environment(folder / "a.exr").pixels[0], 0.1f);
  write_glowing_square(folder, "5");
  EXPECT_EQ(run_program(arguments, folder.path()).exit_code, 0);
  EXPECT_EQ(read_environment(folder / "a.exr").pixels[0], 0.0f);
}

TEST(Render, HeaderTellsHowThePictureWasMade) {
  const TemporaryFolder folder;
  render_square(folder, {"--seed", "77", "-o", "a.exr"});
  const std::string exr = read_text(folder / "a.exr");
  for (const char* const text : {"candil:scene", "square.gltf", "candil:camera", "orbit 35,20", "candil:seed",
                                 "candil:spp", "candil:version", CANDIL_VERSION, "candil:integrator"})
    EXPECT_NE(exr.find(text), std::string::npos) << text;
}

TEST(Render, SameBytesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  render_square(folder, {"--threads", "1", "-o", "1.exr", "-o", "1.png"});
  render_square(folder, {"--threads", "2", "-o", "2.exr", "-o", "2.png"});
  render_square(folder, {"--threads", "7", "-o", "7.exr", "-o", "7.png"});
  for (const std::string extension : {".exr", ".png"}) {
    const std::string one = read_text(folder / ("1" + extension));
    ASSERT_GT(one.size(), 100u);
    EXPECT_EQ(one, read_text(folder / ("2" + extension))) << extension;
    EXPECT_EQ(one, read_text(folder / ("7" + extension))) << extension;
  }
  render_square(folder, {"--seed", "1", "-o", "other.exr"});
  EXPECT_NE(read_text(folder / "other.exr"), read_text(folder / "1.exr"));
}

TEST(Render, StatisticsAreJsonWithWhatTheHarnessReads) {
  const TemporaryFolder folder;
  render_square(folder, {"--stats", "stats.json", "--threads", "2", "--seed", "5"});
  const nlohmann::json stats = nlohmann::json::parse(read_text(folder / "stats.json"));
  EXPECT_GT(stats["render_seconds"].get<double>(), 0);
  EXPECT_GE(stats["load_seconds"].get<double>(), 0);
  EXPECT_GE(stats["bvh_seconds"].get<double>(), 0);
  EXPECT_EQ(stats["spp"], 4);
  EXPECT_EQ(stats["samples"], 32 * 24 * 4);
  EXPECT_EQ(stats["width"], 32);
  EXPECT_EQ(stats["height"], 24);
  EXPECT_EQ(stats["seed"], 5);
  EXPECT_EQ(stats["threads"], 2);
  EXPECT_EQ(stats["non_finite_samples"], 0);
  EXPECT_EQ(stats["rays"]["camera"], 32 * 24 * 4);
  EXPECT_EQ(stats["rays"]["total"], stats["rays"]["camera"].get<long>() + stats["rays"]["bounce"].get<long>() +
                                        stats["rays"]["shadow"].get<long>());
  EXPECT_GT(stats["rays_per_second"].get<double>(), 0);
  EXPECT_GT(stats["peak_memory_bytes"].get<double>(), 1e6);
  EXPECT_GT(stats["bvh_memory_bytes"].get<double>(), 0);
  EXPECT_EQ(stats["scene"]["triangles"], 2);
  EXPECT_EQ(stats["scene"]["instances"], 1);
  EXPECT_EQ(stats["versions"]["candil"], CANDIL_VERSION);
  EXPECT_EQ(stats["versions"]["openimageio"], openimageio_version());
  EXPECT_TRUE(stats["versions"]["embree"].is_string());
}

TEST(Render, LastOfARepeatedOptionCounts) {
  const TemporaryFolder folder;
  render_square(folder, {"--size", "8x8", "--size", "16x4"});
  EXPECT_EQ(decode(read_text(folder / "square.png")).width, 16);
}

TEST(Render, EmptySceneShowsTheBackground) {
  const TemporaryFolder folder;
  write_text(folder / "empty.gltf", R"({"asset": {"version": "2.0"}})");
  const ProgramResult result = run_program(
      {"empty.gltf", "--spp", "1", "--size", "4x4", "--env-color", "0.5,0.5,0.5", "-o", "a.exr"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  for (const float value : read_environment(folder / "a.exr").pixels) EXPECT_NEAR(value, 0.5f, 1e-6f);
}

}  // namespace
}  // namespace candil::test
