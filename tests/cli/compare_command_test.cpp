/// `candil compare`: numbers, exit codes, files, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/color.h"
#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

using nlohmann::json;

/// 32 x 24 pixels of three greys.
Image stripes(int channels = 3) {
  Image image(32, 24, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) image.pixel(x, y)[c] = c == 3 ? 1.0f : 0.2f * static_cast<float>(x % 3 + 1);
  return image;
}

/// a.png and a.exr, and b.png and b.exr, the pixel (5, 7) of which has another green: 0.4 in a (level 102), 0.6 in b
/// (153).
void write_images(const TemporaryFolder& folder) {
  Image image = stripes();
  image.pixel(5, 7)[1] = 0.4f;
  write_image(folder / "a.png", image, false, {});
  write_image(folder / "a.exr", image, false, {});
  image.pixel(5, 7)[1] = 0.6f;
  write_image(folder / "b.png", image, false, {});
  write_image(folder / "b.exr", image, false, {});
}

ProgramResult compare(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "compare");
  return run_program(arguments, folder.path());
}

json compare_json(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", "-q"});
  const ProgramResult result = compare(folder, arguments);
  EXPECT_EQ(result.errors, "");
  return json::parse(result.output);
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void expect_failure(const ProgramResult& result, int exit_code, const std::string& message) {
  EXPECT_EQ(result.exit_code, exit_code) << result.errors << result.output;
  EXPECT_EQ(count_errors(result), 1) << result.errors;
  EXPECT_TRUE(has(result.errors, message)) << result.errors;
  EXPECT_EQ(result.output, "");
}

TEST(CompareCommand, EqualImagesAreTheSame) {
  const TemporaryFolder folder;
  write_images(folder);
  for (const std::string name : {"a.png", "a.exr"}) {
    const ProgramResult result = compare(folder, {name, name});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    EXPECT_TRUE(has(result.output, "0 of 768 pixels differ")) << result.output;
    EXPECT_TRUE(has(result.output, "psnr    inf dB")) << result.output;
    EXPECT_TRUE(result.output.ends_with("same: no value differs\n")) << result.output;
  }
}

// Without a threshold any difference counts, and that is said. One value of 3 * 768 differs by 51 / 255 = 0.2:
// MSE 0.04 / 2304 = 1.736e-5, PSNR 47.6 dB, bias of green 0.2 / 768 = 2.604e-4.
TEST(CompareCommand, NumbersAreAlwaysThere) {
  const TemporaryFolder folder;
  write_images(folder);
  const ProgramResult result = compare(folder, {"a.png", "b.png"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_EQ(result.errors, "");
  for (const char* const part :
       {"A a.png\nB b.png\n32x24 pixels\n", "exact   1 of 768 pixels differ (0.13 %)",
        "max     0.2 (51/255) at 5,7 in G", "mse     1.7361", "psnr    47.60", "bias    R +0, G +0.0002604, B +0",
        "ssim    mean 0.9", "flip    mean 0.0", "different: without a --threshold any difference counts\n"})
    EXPECT_TRUE(has(result.output, part)) << part << '\n' << result.output;
  const json data = compare_json(folder, {"a.png", "b.png"});
  EXPECT_EQ(data.at("same"), false);
  const json& layer = data.at("layers").at(0);
  EXPECT_EQ(layer.at("kind"), "display");
  EXPECT_EQ(layer.at("metrics").at("exact"), 1);
  EXPECT_NEAR(layer.at("metrics").at("max").get<double>(), 0.2, 1e-6);
  EXPECT_NEAR(layer.at("metrics").at("mse").get<double>(), 0.04 / 2304, 1e-10);
  EXPECT_NEAR(layer.at("bias").at("G").get<double>(), 0.2 / 768, 1e-8);
  EXPECT_EQ(layer.at("largest_at"), (json{{"x", 5}, {"y", 7}, {"channel", "G"}}));
}

TEST(CompareCommand, EveryThresholdMustBeMet) {
  const TemporaryFolder folder;
  write_images(folder);
  const auto exit_code = [&](std::vector<std::string> thresholds) {
    std::vector<std::string> arguments = {"a.png", "b.png"};
    for (const std::string& threshold : thresholds) arguments.insert(arguments.end(), {"--threshold", threshold});
    return compare(folder, arguments).exit_code;
  };
  EXPECT_EQ(exit_code({"max=0.21"}), 0);
  EXPECT_EQ(exit_code({"max=0.19"}), 1);
  EXPECT_EQ(exit_code({"max=0.21", "psnr=47", "exact=1", "error:p99=0"}), 0);
  EXPECT_EQ(exit_code({"max=0.21", "psnr=48", "exact=1"}), 1);
  EXPECT_EQ(exit_code({"flip:max=0.01"}), 1);
  EXPECT_EQ(exit_code({"flip:p50=0.01", "ssim=0.9", "ssim:min=0"}), 0);
  const ProgramResult result =
      compare(folder, {"a.png", "b.png", "-t", "max=0.1", "-t", "psnr=10", "-t", "ssim:min=1"});
  EXPECT_TRUE(has(result.output, "  max 0.2 <= 0.1: NO\n  psnr 47.6")) << result.output;
  EXPECT_TRUE(has(result.output, "different: max is 0.2, more than 0.1, ssim:min is 0.")) << result.output;
  EXPECT_TRUE(has(result.output, ", less than 1\n")) << result.output;
}

TEST(CompareCommand, RegionsAndMasksSelectPixels) {
  const TemporaryFolder folder;
  write_images(folder);
  EXPECT_EQ(compare(folder, {"a.png", "b.png", "--region", "6,0,26x24"}).exit_code, 0);
  EXPECT_EQ(compare(folder, {"a.png", "b.png", "--region", "5,7,1x1"}).exit_code, 1);
  EXPECT_EQ(compare(folder, {"a.png", "b.png", "--region", "8,8,4x4", "--region", "0,0,6x8"}).exit_code, 1);
  Image mask(32, 24, 3);
  for (int x = 0; x < 32; ++x)
    for (int c = 0; c < 3; ++c) mask.pixel(x, 6)[c] = 1;
  write_image(folder / "mask.png", mask, false, {});
  const ProgramResult result = compare(folder, {"a.png", "b.png", "--mask", "mask.png"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(has(result.output, "(32 pixels)")) << result.output;
  write_image(folder / "none.png", Image(32, 24, 3), false, {});
  write_image(folder / "small.png", Image(3, 2, 3), false, {});
  expect_failure(compare(folder, {"a.png", "b.png", "--mask", "none.png"}), 3, "none.png: no pixel is left");
  expect_failure(compare(folder, {"a.png", "b.png", "--mask", "small.png"}), 3, "small.png: 3x2 pixels, but");
  expect_failure(compare(folder, {"a.png", "b.png", "--region", "30,0,3x1"}), 2, "--region: 30,0,3x1 reaches beyond");
}

TEST(CompareCommand, DifferentSizesAreRefusedOrAligned) {
  const TemporaryFolder folder;
  Image small(16, 12, 3), large(32, 24, 3);
  std::ranges::fill(small.pixels, 0.5f), std::ranges::fill(large.pixels, 0.5f);
  write_image(folder / "small.exr", small, false, {});
  write_image(folder / "large.exr", large, false, {});
  expect_failure(compare(folder, {"small.exr", "large.exr"}), 3,
                 "large.exr: 32x24 pixels, but small.exr has 16x12; --align resize");
  const ProgramResult result =
      compare(folder, {"small.exr", "large.exr", "--align", "resize", "--threshold", "max=1e-6"});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_TRUE(has(result.output, "note: B was resized")) << result.output;
}

// sRGB on one side only: as linear values. Alpha on one side only: the other is opaque.
TEST(CompareCommand, KindsAndChannelsAreMadeEqual) {
  const TemporaryFolder folder;
  Image encoded(8, 8, 3), linear(8, 8, 3), alpha(8, 8, 4);
  std::ranges::fill(encoded.pixels, 128 / 255.0f);
  std::ranges::fill(linear.pixels, srgb_to_linear(128 / 255.0f));
  std::ranges::fill(alpha.pixels, 128 / 255.0f);
  for (std::size_t i = 3; i < alpha.pixels.size(); i += 4) alpha.pixels[i] = 1;
  write_image(folder / "encoded.png", encoded, false, {});
  write_image(folder / "linear.exr", linear, false, {});
  write_image(folder / "opaque.png", alpha, true, {});
  alpha.pixels[3] = 0.2f;
  write_image(folder / "hole.png", alpha, true, {});
  const ProgramResult mixed = compare(folder, {"encoded.png", "linear.exr", "-t", "max=1e-6"});
  EXPECT_EQ(mixed.exit_code, 0) << mixed.output;
  EXPECT_TRUE(has(mixed.output, "note: A is sRGB and the other linear")) << mixed.output;
  EXPECT_EQ(compare(folder, {"encoded.png", "opaque.png"}).exit_code, 0);
  const ProgramResult hole = compare(folder, {"encoded.png", "hole.png"});
  EXPECT_EQ(hole.exit_code, 1);
  EXPECT_TRUE(has(hole.output, "note: picture: A has no alpha, it counts as opaque")) << hole.output;
  EXPECT_TRUE(has(hole.output, "max     0.8 (204/255) at 0,0 in A")) << hole.output;
}

/// Two files that differ in the layer "depth" only; "extra" is in b alone.
void write_layered(const TemporaryFolder& folder) {
  Image depth(32, 24, 1);
  std::vector<ImageLayer> layers = {{"", {"R", "G", "B"}, stripes()}, {"depth", {"Z"}, depth}};
  write_layers(folder / "a.exr", layers, {});
  layers[1].image.pixels[40] = 3;
  layers.push_back({"extra", {"U", "V"}, Image(32, 24, 2)});
  write_layers(folder / "b.exr", layers, {});
}

TEST(CompareCommand, LayersAreFoundByName) {
  const TemporaryFolder folder;
  write_layered(folder);
  const ProgramResult picture = compare(folder, {"a.exr", "b.exr"});
  EXPECT_EQ(picture.exit_code, 0) << picture.output;
  EXPECT_TRUE(has(picture.output, "note: not compared: depth, extra (--layer NAME, --layer all)")) << picture.output;
  const ProgramResult depth = compare(folder, {"a.exr", "b.exr", "--layer", "depth"});
  EXPECT_EQ(depth.exit_code, 1);
  EXPECT_TRUE(has(depth.output, "depth: no colours (768 pixels)")) << depth.output;
  EXPECT_TRUE(has(depth.output, "max     3 at 8,1 in Z")) << depth.output;
  EXPECT_FALSE(has(depth.output, "flip")) << depth.output;
  const json all = compare_json(folder, {"a.exr", "b.exr", "--layer", "all", "-t", "flip=0.1", "-t", "max=3"});
  EXPECT_EQ(all.at("same"), true);
  EXPECT_EQ(all.at("layers").size(), 2u);
  EXPECT_EQ(all.at("layers").at(1).at("thresholds").size(), 1u);  // there is no FLIP of depths
  EXPECT_EQ(compare(folder, {"a.exr", "b.exr", "--layer", "picture"}).exit_code, 0);
  expect_failure(compare(folder, {"a.exr", "b.exr", "--layer", "extra"}), 3,
                 "a.exr: no layer 'extra'; it has: picture, depth");
  expect_failure(compare(folder, {"a.exr", "b.exr", "--layer", "depth", "-t", "flip=1"}), 3,
                 "cannot be judged by flip: no layer that is compared has colours");
}

TEST(CompareCommand, FilesWithoutAPictureAreComparedByWhatTheyHave) {
  const TemporaryFolder folder;
  write_layers(folder / "a.exr", std::vector<ImageLayer>{{"depth", {"Z"}, Image(4, 4, 1)}}, {});
  EXPECT_EQ(compare(folder, {"a.exr", "a.exr"}).exit_code, 0);
  write_image(folder / "b.exr", Image(4, 4, 3), false, {});
  expect_failure(compare(folder, {"a.exr", "b.exr"}), 3, "a.exr: no layer 'picture'; it has: depth");
}

TEST(CompareCommand, NaNNeverPasses) {
  const TemporaryFolder folder;
  Image image = stripes();
  write_image(folder / "a.exr", image, false, {});
  image.pixel(3, 3)[0] = std::nanf("");
  write_image(folder / "b.exr", image, false, {});
  for (const char* const threshold : {"max=1e30", "mse=1e30", "bias=1e30", "psnr=-1e30", "flip:max=0.99", "exact=0"})
    EXPECT_EQ(compare(folder, {"a.exr", "b.exr", "-t", threshold}).exit_code, 1) << threshold;
  EXPECT_EQ(compare(folder, {"b.exr", "b.exr"}).exit_code, 0);
  const json data = compare_json(folder, {"a.exr", "b.exr"});
  EXPECT_TRUE(data.at("layers").at(0).at("metrics").at("max").is_null());
  EXPECT_EQ(data.at("layers").at(0).at("non_finite_pixels"), 1);
}

// The same scene with two seeds is the same by the z-test and nothing else; another colour is not.
TEST(CompareCommand, ZTestTellsNoiseFromChange) {
  const TemporaryFolder folder;
  write_square_scene(folder);
  std::string scene = read_text(folder / "square.gltf");
  scene.replace(scene.find("0.7, 0.3, 0.2"), 13, "0.7, 0.3, 0.22");
  write_text(folder / "other.gltf", scene);
  const auto render = [&](const std::string& input, const std::string& output, const std::string& seed,
                          const std::string& samples) {
    return run_program({input, "-o", output, "--size", "64x48", "--spp", samples, "--seed", seed, "--variance", "-q"},
                       folder.path())
        .exit_code;
  };
  EXPECT_EQ(render("square.gltf", "a.exr", "1", "64"), 0);
  EXPECT_EQ(render("square.gltf", "b.exr", "2", "32"), 0);
  EXPECT_EQ(render("other.gltf", "c.exr", "3", "64"), 0);
  EXPECT_EQ(render("square.gltf", "d.exr", "4", "1"), 0);
  EXPECT_EQ(compare(folder, {"a.exr", "b.exr"}).exit_code, 1);
  const ProgramResult noise = compare(folder, {"a.exr", "b.exr", "-t", "ztest=1e-6"});
  EXPECT_EQ(noise.exit_code, 0) << noise.output;
  EXPECT_TRUE(has(noise.output, "noise explains the differences")) << noise.output;
  const ProgramResult change = compare(folder, {"a.exr", "c.exr", "-t", "ztest=1e-6"});
  EXPECT_EQ(change.exit_code, 1) << change.output;
  EXPECT_TRUE(has(change.output, "most clearly B in")) << change.output;
  const json data = compare_json(folder, {"a.exr", "c.exr"});
  EXPECT_LT(data.at("layers").at(0).at("metrics").at("ztest").get<double>(), 1e-6);
  EXPECT_EQ(data.at("layers").at(0).at("ztest").at("worst").at("channel"), "B");
  expect_failure(compare(folder, {"a.exr", "d.exr", "-t", "ztest=1e-6"}), 3, "cannot be judged by ztest");
  write_images(folder);
  expect_failure(compare(folder, {"a.png", "b.png", "-t", "ztest=1e-6"}), 3, "cannot be judged by ztest");
}

TEST(CompareCommand, WritesJsonToAFileOrStandardOutput) {
  const TemporaryFolder folder;
  write_images(folder);
  const ProgramResult both = compare(folder, {"--json", "a.png", "b.png"});
  EXPECT_EQ(both.exit_code, 1);
  EXPECT_EQ(json::parse(both.output).at("b"), "b.png");
  EXPECT_TRUE(has(both.errors, "different:")) << both.errors;
  const ProgramResult file = compare(folder, {"a.png", "b.png", "--json=out.json"});
  EXPECT_TRUE(has(file.output, "different:"));
  EXPECT_EQ(json::parse(read_text(folder / "out.json")), json::parse(both.output));
}

TEST(CompareCommand, WritesHeatMapsAndTheirValues) {
  const TemporaryFolder folder;
  write_images(folder);
  EXPECT_EQ(compare(folder, {"a.png", "b.png", "--diff", "d.png"}).exit_code, 1);
  EXPECT_EQ(compare(folder, {"a.png", "b.png", "--diff", "d.exr"}).exit_code, 1);
  const Image values = read_image(folder / "d.exr"), picture = read_image(folder / "d.png");
  EXPECT_EQ(values.width, 32);
  EXPECT_GT(values.pixel(5, 7)[0], 0.1f);
  EXPECT_EQ(values.pixel(31, 23)[0], 0);
  EXPECT_GT(picture.pixel(5, 7)[0], picture.pixel(31, 23)[0]);
}

// What a browser makes of it: compare_report_test.py. Here: nothing from outside, and no name gets to be a tag.
TEST(CompareCommand, ReportIsOneFileThatNeedsNothingElse) {
  const TemporaryFolder folder;
  write_images(folder);
  std::filesystem::rename(folder / "b.exr", folder / "<script>b&.exr");
  EXPECT_EQ(compare(folder, {"a.exr", "<script>b&.exr", "--html", "report.html"}).exit_code, 1);
  const std::string report = read_text(folder / "report.html");
  EXPECT_TRUE(has(report, "&lt;script&gt;b&amp;.exr"));
  EXPECT_FALSE(has(report, "<script>b"));
  EXPECT_FALSE(has(report, "{{"));
  EXPECT_FALSE(has(report, "http://") || has(report, "https://") || has(report, "src=\"/"));
  EXPECT_EQ(compare(folder, {"a.exr", "<script>b&.exr", "--html", "again.html"}).exit_code, 1);
  EXPECT_EQ(read_text(folder / "again.html"), report);
}

TEST(CompareCommand, UnreadableImagesGiveThree) {
  const TemporaryFolder folder;
  write_images(folder);
  write_text(folder / "text.png", "no image");
  const std::string whole = read_text(folder / "a.exr");
  write_text(folder / "short.exr", whole.substr(0, whole.size() / 2));
  for (const std::string name : {"missing.png", "text.png", "short.exr"}) {
    expect_failure(compare(folder, {name, "b.png"}), 3, name + ": ");
    expect_failure(compare(folder, {"a.png", name}), 3, name + ": ");
  }
  expect_failure(compare(folder, {"missing.png", "text.png"}), 3, "missing.png: no such file");
}

TEST(CompareCommand, UnwritableOutputsGiveFourBeforeAnythingIsCompared) {
  const TemporaryFolder folder;
  write_images(folder);
  for (const std::string option : {"--diff", "--html"})
    expect_failure(compare(folder, {"a.png", "b.png", option, "missing/d.png"}), 4, "missing/d.png");
  expect_failure(compare(folder, {"a.png", "b.png", "--json=missing/d.json"}), 4, "missing/d.json");
}

TEST(CompareCommand, NeverReplacesAnInput) {
  const TemporaryFolder folder;
  write_images(folder);
  const std::string before = read_text(folder / "b.png");
  expect_failure(compare(folder, {"a.png", "b.png", "--diff", "./b.png"}), 2, "--diff: ./b.png is an input");
  expect_failure(compare(folder, {"a.png", "b.png", "--html", "a.png"}), 2, "--html: a.png is an input");
  expect_failure(compare(folder, {"a.png", "b.png", "--json=b.png"}), 2, "--json: b.png is an input");
  expect_failure(compare(folder, {"a.png", "a.png", "--mask", "b.png", "--diff", "b.png"}), 2, "b.png is an input");
  EXPECT_EQ(read_text(folder / "b.png"), before);
}

TEST(CompareCommand, WrongUsageGivesTwo) {
  const TemporaryFolder folder;
  write_images(folder);
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"a.png"}, "B"},
      {{"a.png", "b.png", "c.png"}, "c.png"},
      {{"a.png", "b.png", "-t", "flip"}, "--threshold: 'flip' is not METRIC=VALUE"},
      {{"a.png", "b.png", "-t", "fllp=1"}, "--threshold: 'fllp' is not one of exact, max"},
      {{"a.png", "b.png", "-t", "flip=x"}, "--threshold: 'x' is not a number"},
      {{"a.png", "b.png", "-t", "flip=nan"}, "--threshold: 'nan' is not a number"},
      {{"a.png", "b.png", "-t", "flip:q9=1"}, "'q9' is not a percentile"},
      {{"a.png", "b.png", "-t", "flip:p101=1"}, "101 is not between 0 and 100"},
      {{"a.png", "b.png", "-t", "mse:p9=1"}, "mse has no map"},
      {{"a.png", "b.png", "--region", "1,2"}, "--region: '1,2' is not a region"},
      {{"a.png", "b.png", "--region", "0,0,0x4"}, "--region: '0x4' is not a size"},
      {{"a.png", "b.png", "--align", "crop"}, "--align: 'crop' is not one of none, resize"},
      {{"a.png", "b.png", "--ppd", "0"}, "--ppd: 0 is not between"},
      {{"a.png", "b.png", "--diff", "d.gif"}, "--diff: d.gif: unknown format"},
  };
  for (const auto& [arguments, message] : wrong) expect_failure(compare(folder, arguments), 2, message);
}

}  // namespace
}  // namespace candil::test
