/// What `candil tonemap` leaves behind, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <span>

#include "core/color.h"
#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

TextureImage decode(const std::string& bytes) {
  return decode_texture(std::as_bytes(std::span(bytes)), "picture", "test", "");
}

/// linear.exr: 0.18, 1 and 4, grey.
void write_linear(const TemporaryFolder& folder) {
  Image image(3, 1, 3);
  image.pixels = {0.18f, 0.18f, 0.18f, 1, 1, 1, 4, 4, 4};
  write_image(folder / "linear.exr", image, false, {});
}

/// The red bytes of the picture that `arguments` make of linear.exr.
std::vector<int> shown(std::vector<std::string> arguments) {
  const TemporaryFolder folder;
  write_linear(folder);
  arguments.insert(arguments.begin(), {"tonemap", "linear.exr", "-o", "a.png"});
  const ProgramResult result = run_program(arguments, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  std::vector<int> levels;
  for (const glm::u8vec4 pixel : decode(read_text(folder / "a.png")).rgba8) levels.push_back(pixel.x);
  return levels;
}

int level(float value) { return static_cast<int>(value * 255 + 0.5f); }

TEST(TonemapCommand, WithoutOptionsWritesAPngNamedAfterTheInput) {
  const TemporaryFolder folder;
  write_linear(folder);
  const ProgramResult result = run_program({"tonemap", "linear.exr"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"linear.exr", "linear.png"}));
  EXPECT_EQ(result.errors, "wrote linear.png (3x1)\n");
  EXPECT_FALSE(decode(read_text(folder / "linear.png")).has_alpha);
}

// clamp: 0.18 by the sRGB curve (0.461356, level 118), 1 and 4 white; two stops down: 0.045, 0.25, 1.
TEST(TonemapCommand, AppliesOperatorAndExposure) {
  EXPECT_EQ(shown({"--operator", "clamp"}), (std::vector<int>{118, 255, 255}));
  EXPECT_EQ(shown({"--tonemap", "clamp"}), (std::vector<int>{118, 255, 255}));
  EXPECT_EQ(shown({"--operator", "clamp", "--exposure", "-2"}),
            (std::vector<int>{level(linear_to_srgb(0.045f)), level(linear_to_srgb(0.25f)), 255}));
}

// gamma 2 with white 4: sqrt(0.045), sqrt(0.25), 1, and no other curve.
TEST(TonemapCommand, PassesParameters) {
  EXPECT_EQ(shown({"--operator", "gamma:gamma=2,white=4"}),
            (std::vector<int>{level(std::sqrt(0.045f)), level(0.5f), 255}));
  EXPECT_EQ(shown({"--operator", "neutral", "--operator", "clamp-gamma:share=0.25,gamma=1"}),
            (std::vector<int>{level(0.18f), 255, 255}));
}

TEST(TonemapCommand, WritesToStandardOutput) {
  const TemporaryFolder folder;
  write_linear(folder);
  const ProgramResult result = run_program({"tonemap", "linear.exr", "-o", "-", "--quiet"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_EQ(decode(result.output).width, 3);
}

TEST(TonemapCommand, KeepsAlpha) {
  const TemporaryFolder folder;
  Image image(2, 1, 4);
  image.pixels = {0.09f, 0.09f, 0.09f, 0.5f, 0, 0, 0, 0};
  write_image(folder / "a.exr", image, true, {});
  const ProgramResult result = run_program(
      {"tonemap", "a.exr", "-o", "a.png", "-o", "a.jpg", "-o", "b.exr", "--operator", "clamp"}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  // 0.09 of alpha 0.5 is 0.18: level 118; alpha 0.5 is level 128.
  const TextureImage png = decode(read_text(folder / "a.png"));
  EXPECT_EQ(png.rgba8, (std::vector<glm::u8vec4>{{118, 118, 118, 128}, {0, 0, 0, 0}}));
  EXPECT_EQ(read_image(folder / "b.exr").pixels, image.pixels);
  EXPECT_NE(result.errors.find("warning: a.jpg: the format has no alpha"), std::string::npos) << result.errors;
}

// The float 0.18 is 0.180000007, and 1e9 stands for 4: 45000001.8 of it.
TEST(TonemapCommand, WritesEveryKindOfPpm) {
  const TemporaryFolder folder;
  write_linear(folder);
  for (const std::string kind : {"binary", "ascii", "hdr"}) {
    const ProgramResult result = run_program(
        {"tonemap", "linear.exr", "-o", kind + ".ppm", "--ppm", kind, "--operator", "clamp"}, folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.errors;
  }
  EXPECT_EQ(read_text(folder / "binary.ppm"), "P6\n3 1\n255\nvvv\xff\xff\xff\xff\xff\xff");  // 'v' is 118
  EXPECT_EQ(read_text(folder / "ascii.ppm"), "P3\n3 1\n255\n118 118 118\n255 255 255\n255 255 255\n");
  EXPECT_EQ(read_text(folder / "hdr.ppm"),
            "P3\n#MAX=4\n3 1\n1000000000\n45000002 45000002 45000002\n250000000 250000000 250000000\n"
            "1000000000 1000000000 1000000000\n");
  const ProgramResult back = run_program({"tonemap", "hdr.ppm", "-o", "back.exr"}, folder.path());
  EXPECT_EQ(back.exit_code, 0) << back.errors;
  EXPECT_EQ(read_image(folder / "back.exr").pixels, read_image(folder / "linear.exr").pixels);
}

// The values of a render's EXR and of its PPM are the same but for the step of the PPM, 1e-9 of the largest value.
TEST(TonemapCommand, DoesWhatRenderDoes) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const ProgramResult render =
      run_program({"square.gltf", "--spp", "1", "--size", "16x12", "-o", "a.exr", "-o", "a.png", "-o", "a.ppm", "--ppm",
                   "hdr", "--tonemap", "reinhard02:key=0.3,white=2"},
                  folder.path());
  EXPECT_EQ(render.exit_code, 0) << render.errors;
  for (const std::string input : {"a.exr", "a.ppm"}) {
    const ProgramResult result =
        run_program({"tonemap", input, "-o", "b.png", "--operator", "reinhard02:key=0.3,white=2"}, folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    const TextureImage a = decode(read_text(folder / "a.png")), b = decode(read_text(folder / "b.png"));
    ASSERT_EQ(a.rgba8.size(), b.rgba8.size());
    for (std::size_t i = 0; i < a.rgba8.size(); ++i)
      EXPECT_TRUE(
          glm::all(glm::lessThanEqual(glm::abs(glm::ivec4(a.rgba8[i]) - glm::ivec4(b.rgba8[i])), glm::ivec4(1))))
          << input << " pixel " << i;
  }
}

TEST(TonemapCommand, WarnsOfValuesThatAreNotFinite) {
  const TemporaryFolder folder;
  Image image(2, 1, 3);
  image.pixels = {std::nanf(""), 0, 0, 1, INFINITY, 1};
  write_image(folder / "a.exr", image, false, {});
  const ProgramResult result = run_program({"tonemap", "a.exr", "-o", "a.png", "--operator", "clamp"}, folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find("warning: a.exr: 2 values are not finite"), std::string::npos) << result.errors;
  EXPECT_EQ(decode(read_text(folder / "a.png")).rgba8,
            (std::vector<glm::u8vec4>{{0, 0, 0, 255}, {255, 255, 255, 255}}));
}

void expect_failure(const ProgramResult& result, int exit_code, const std::string& message) {
  EXPECT_EQ(result.exit_code, exit_code) << result.errors;
  EXPECT_EQ(count_errors(result), 1) << result.errors;
  EXPECT_NE(result.errors.find(message), std::string::npos) << result.errors;
  EXPECT_EQ(result.output, "");
}

TEST(TonemapCommand, UnusableInputGivesThree) {
  const TemporaryFolder folder;
  write_text(folder / "text.exr", "no image");
  write_text(folder / "short.ppm", "P3\n#MAX=5\n2 2\n1000\n1 2 3\n");
  expect_failure(run_program({"tonemap", "missing.exr"}, folder.path()), 3, "missing.exr: no such file");
  expect_failure(run_program({"tonemap", "text.exr"}, folder.path()), 3, "text.exr: not an HDR");
  expect_failure(run_program({"tonemap", "short.ppm"}, folder.path()), 3, "short.ppm: the PPM is cut short");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"short.ppm", "text.exr"}));
}

TEST(TonemapCommand, UnwritableOutputGivesFour) {
  const TemporaryFolder folder;
  write_linear(folder);
  expect_failure(run_program({"tonemap", "linear.exr", "-o", "missing/a.png"}, folder.path()), 4, "missing/a.png");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"linear.exr"});
}

TEST(TonemapCommand, NeverReplacesItsInput) {
  const TemporaryFolder folder;
  write_linear(folder);
  std::filesystem::create_symlink("linear.exr", folder / "link.exr");
  const std::string before = read_text(folder / "linear.exr");
  for (const std::string name : {"linear.exr", "./linear.exr", "link.exr"})
    expect_failure(run_program({"tonemap", "linear.exr", "-o", "a.png", "-o", name}, folder.path()), 2,
                   "is the input itself");
  EXPECT_EQ(read_text(folder / "linear.exr"), before);
  std::filesystem::rename(folder / "linear.exr", folder / "linear.png");
  expect_failure(run_program({"tonemap", "linear.png"}, folder.path()), 2, "is the input itself");
  EXPECT_EQ(read_text(folder / "linear.png"), before);
}

}  // namespace
}  // namespace candil::test
