/// `candil fidelity`: scenarios of the Khronos render fidelity harness.
#include <gtest/gtest.h>

#include <span>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

TextureImage read_png(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  return decode_texture(std::as_bytes(std::span(bytes)), "picture", "test", "");
}

glm::u8vec4 pixel(const TextureImage& image, int x, int y) {
  return image.rgba8[static_cast<std::size_t>(y) * image.width + x];
}

std::string one_argument(const std::string& scenario, const std::string& output = "out.png") {
  return R"({"scenario":{"name":"test",)" + scenario + R"(},"outputFile":")" + output + R"("})";
}

// The eye stands 4 m before a square of 2 m, and sees 4 m of height: tan(fov / 2) = 2 / 4. With 40 x 20 pixels and the
// harness' ratio of 2 the picture has 80 x 40, the square 20 x 20 in its middle.
TEST(FidelityCommand, RendersAsTheHarnessAsks) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const std::string scenario =
      one_argument(R"("model":"../../../square.gltf","dimensions":{"width":40,"height":20},"orbit":{"radius":4},)"
                   R"("verticalFoV":53.13010,"renderSkybox":false)");
  const ProgramResult result = run_program({"fidelity", "--spp", "4", "--filter", "box", scenario}, folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  const TextureImage image = read_png(folder / "out.png");
  ASSERT_EQ(image.width, 80);
  ASSERT_EQ(image.height, 40);
  EXPECT_TRUE(image.has_alpha);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 80; ++x)
      EXPECT_EQ(pixel(image, x, y).w, x >= 30 && x < 50 && y >= 10 && y < 30 ? 255 : 0) << x << " " << y;
}

// From the right (theta 45) the right edge of the square is nearer, from above (phi 45) the upper one; what is nearer is
// longer.
TEST(FidelityCommand, OrbitsAsTheHarnessDoes) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const auto render = [&](const std::string& orbit) {
    const std::string scenario = one_argument(
        R"("model":"square.gltf","dimensions":{"width":40,"height":40},"orbit":{"radius":4,)" + orbit + "}");
    const ProgramResult result = run_program(
        {"fidelity", "--base", ".", "--pixel-ratio", "1", "--spp", "4", "--filter", "box", scenario}, folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return read_png(folder / "out.png");
  };
  const auto count = [](const TextureImage& image, int x0, int x1, int y0, int y1) {
    int covered = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) covered += pixel(image, x, y).w > 0;
    return covered;
  };
  const auto columns = [&](const TextureImage& image, int x) { return count(image, x, x + 1, 0, 40); };
  const TextureImage right = render(R"("theta":45)");
  EXPECT_GT(columns(right, 27), columns(right, 12));
  const TextureImage above = render(R"("phi":45)");
  EXPECT_GT(count(above, 0, 40, 12, 13), count(above, 0, 40, 27, 28));
}

// An image of eight columns: red around a quarter of the width, blue around the middle. The browsers of the harness show
// the middle along +X, and so the quarter along -Z. The radius 0 looks out of the target.
TEST(FidelityCommand, TurnsTheLightingAsTheHarnessDoes) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  Image sky(8, 4, 3);
  for (int y = 0; y < 4; ++y)
    for (const int x : {1, 2}) sky.pixel(x, y)[0] = 1, sky.pixel(x + 2, y)[2] = 1;
  write_image(folder / "sky.pfm", sky, false, {});
  const auto color_towards = [&](const std::string& theta) {
    write_text(folder / "scenario.json",
               one_argument(R"("model":"square.gltf","lighting":"sky.pfm","renderSkybox":true,"target":{"z":-5},)"
                            R"("dimensions":{"width":8,"height":8},"verticalFoV":10,"orbit":{"radius":0,"theta":)" +
                            theta + "}"));
    const ProgramResult result =
        run_program({"fidelity", "scenario.json", "--spp", "1", "--tonemap", "none"}, folder.path());
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    const TextureImage image = read_png(folder / "out.png");
    EXPECT_FALSE(image.has_alpha);
    return pixel(image, 8, 8);
  };
  EXPECT_EQ(color_towards("0"), glm::u8vec4(255, 0, 0, 255)) << "along -Z";
  EXPECT_EQ(color_towards("-90"), glm::u8vec4(0, 0, 255, 255)) << "along +X";
}

TEST(FidelityCommand, RefusesWhatIsNoScenario) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  const auto expect_error = [&](const std::string& scenario, const std::string& message) {
    const ProgramResult result = run_program({"fidelity", "--base", ".", scenario}, folder.path());
    EXPECT_EQ(result.exit_code, 3) << scenario;
    EXPECT_EQ(count_errors(result), 1) << result.errors;
    EXPECT_NE(result.errors.find(message), std::string::npos) << result.errors;
  };
  expect_error("missing.json", "missing.json");
  expect_error("{", "scenario: JSON: ");
  expect_error("{}", "scenario: model: is missing");
  expect_error(R"({"scenario":[]})", "scenario: scenario: must be an object");
  expect_error(one_argument(R"("model":7)"), "scenario.model: must be a string");
  expect_error(one_argument(R"("model":"square.gltf","orbit":{"radius":-1})"),
               "scenario.orbit.radius: must be between");
  expect_error(one_argument(R"("model":"square.gltf","dimensions":{"width":"1"})"),
               "scenario.dimensions.width: must be a number");
  expect_error(one_argument(R"("model":"nothing.glb")"), "nothing.glb");
  EXPECT_EQ(run_program({"fidelity"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run_program({"fidelity", "{}", "--pixel-ratio", "0"}, folder.path()).exit_code, 2);
}

}  // namespace
}  // namespace candil::test
