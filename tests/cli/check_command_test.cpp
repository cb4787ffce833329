/// `candil check`: what it prints, leaves behind, and answers to the shell.
#include <gtest/gtest.h>

#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* suite_text = R"([defaults]
args = ["--size", "32x32", "--spp", "8"]

[[test]]
name = "front"
scene = "square.gltf"
tags = ["easy"]

[[test]]
name = "side"
scene = "square.gltf"
args = ["--orbit", "30,10", "--tonemap", "aces"]
)";

/// A folder with a suite of two tests.
class CheckFolder {
 public:
  CheckFolder() {
    write_square_scene(folder_);
    write_text(folder_ / "suite.toml", suite_text);
  }
  /// `candil check suite.toml` and these words.
  ProgramResult run(std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {"check", "suite.toml"});
    return run_program(words, folder_.path());
  }
  fs::path operator/(std::string_view name) const { return folder_ / name; }
  std::vector<std::string> names() const { return folder_.names(); }

  /// Another colour: red of 0.7 becomes `red`.
  void paint(const std::string& red) const {
    std::string scene = read_text(folder_ / "square.gltf");
    const std::size_t at = scene.find("[0.7,");
    write_text(folder_ / "square.gltf", scene.replace(at, 5, "[" + red + ","));
  }

 private:
  TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Check, AMissingGoldenImageFailsAndTellsHowToMakeIt) {
  const CheckFolder folder;
  const ProgramResult result = folder.run();
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_TRUE(contains(result.output, "candil check suite.toml --update front")) << result.output;
  EXPECT_FALSE(fs::exists(folder / "golden"));
  EXPECT_TRUE(fs::exists(folder / "candil-check/front/render.png"));
}

TEST(Check, UpdateMakesGoldenImagesThatPassWithAnySeedAndThreads) {
  const CheckFolder folder;
  EXPECT_EQ(folder.run({"--update"}).exit_code, 0);
  for (const auto& words : std::vector<std::vector<std::string>>{
           {}, {"--seed", "7"}, {"--threads", "1"}, {"--jobs", "3"}, {"--accel", "brute"}}) {
    const ProgramResult result = folder.run(words);
    EXPECT_EQ(result.exit_code, 0) << result.output << result.errors;
    EXPECT_TRUE(contains(result.output, "2 tests: 2 passed, 0 failed")) << result.output;
  }
  EXPECT_FALSE(fs::exists(folder / "candil-check/front"));
}

TEST(Check, GoldenImagesCarryVarianceAndWhatMadeThem) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  const LayeredImage file = read_layers(folder / "golden/side.exr", [](const auto& names) { return names; });
  EXPECT_EQ(file.names, (std::vector<std::string>{"", "display", "variance"}));
  std::map<std::string, std::string> texts(file.metadata.begin(), file.metadata.end());
  EXPECT_EQ(texts["candil:spp"], "8");
  EXPECT_EQ(texts["candil:seed"], "0");
  EXPECT_EQ(texts["candil:version"], CANDIL_VERSION);
  EXPECT_EQ(texts["candil:scene_hash"].size(), 16u);
  EXPECT_TRUE(contains(texts["candil:settings"], "--tonemap aces"));
  EXPECT_EQ(read_layers(folder / "golden/front.exr", [](const auto& names) { return names; }).names,
            (std::vector<std::string>{"", "variance"}));
}

// 1 % of the red of the only material.
TEST(Check, ASmallChangeFailsAndIsExplained) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  folder.paint("0.707");
  const ProgramResult result = folder.run({"--html", "report", "--junit", "out.xml"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.output, "channel R")) << result.output;
  EXPECT_TRUE(contains(result.output, "candil render square.gltf --size 32x32 --spp 8 -o front.exr")) << result.output;
  for (const char* name : {"render.exr", "golden.exr", "render.png", "golden.png", "heat.png", "command.txt"})
    EXPECT_TRUE(fs::exists(folder / "candil-check/front" / name)) << name;
  const std::string page = read_text(folder / "report/index.html");
  EXPECT_TRUE(contains(page, "2 of 2 tests failed"));
  EXPECT_TRUE(contains(page, "data:image/png;base64,"));
  EXPECT_FALSE(contains(page, "src=\"http"));
  EXPECT_TRUE(contains(read_text(folder / "out.xml"), "tests=\"2\" failures=\"2\" errors=\"0\""));
  // What passes leaves nothing.
  fs::remove(folder / "square.gltf");
  const CheckFolder fresh;
  fs::copy(fresh / "square.gltf", folder / "square.gltf");
  EXPECT_EQ(folder.run().exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "candil-check/front"));
}

TEST(Check, TheReproducingCommandMakesTheSamePicture) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  folder.paint("0.9");
  ASSERT_EQ(folder.run().exit_code, 1);
  ASSERT_EQ(run_program({"render", "square.gltf", "--size", "32x32", "--spp", "8", "-o", "front.exr"},
                        (folder / "").parent_path())
                .exit_code,
            0);
  const Image image = read_image(folder / "front.exr"), left = read_image(folder / "candil-check/front/render.exr");
  ASSERT_EQ(image.pixels.size(), left.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(image.pixels[i], left.pixels[i], image.pixels[i] * 0x1p-11f);  // rounded to 11 bits
}

TEST(Check, UpdateKeepsWhatHasNotChangedByteForByte) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  const std::string front = read_text(folder / "golden/front.exr"), side = read_text(folder / "golden/side.exr");
  const fs::file_time_type time = fs::last_write_time(folder / "golden/front.exr");
  EXPECT_TRUE(contains(folder.run({"--update"}).output, "0 golden images written, 2 kept"));
  EXPECT_EQ(fs::last_write_time(folder / "golden/front.exr"), time);
  folder.paint("0.9");
  const ProgramResult result = folder.run({"--update", "front"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(contains(result.output, "front: golden/front.exr changes: ztest")) << result.output;
  EXPECT_TRUE(contains(result.output, "1 golden images written")) << result.output;
  EXPECT_NE(read_text(folder / "golden/front.exr"), front);
  EXPECT_EQ(read_text(folder / "golden/side.exr"), side);
}

TEST(Check, UpdateLeavesTestsThatDidNotRunAlone) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  const std::string front = read_text(folder / "golden/front.exr");
  write_text(folder / "square.gltf", "{");
  const ProgramResult result = folder.run({"--update"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.output, "front: not updated: ")) << result.output;
  EXPECT_EQ(read_text(folder / "golden/front.exr"), front);
}

TEST(Check, ResumeSkipsWhatHasPassedUntilSomethingChanges) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  ASSERT_EQ(folder.run({"--filter", "front"}).exit_code, 0);
  fs::remove_all(folder / "candil-check");
  ASSERT_EQ(folder.run({"--filter", "front"}).exit_code, 0);
  const ProgramResult second = folder.run({"--resume"});
  EXPECT_TRUE(contains(second.output, "2 tests: 2 passed (1 of them before)")) << second.output;
  EXPECT_TRUE(contains(folder.run({"--resume"}).output, "(2 of them before)"));
  EXPECT_FALSE(contains(folder.run({"--resume", "--seed", "3"}).output, "before"));
  folder.paint("0.9");
  EXPECT_EQ(folder.run({"--resume"}).exit_code, 1);
}

TEST(Check, FiltersAndShardsPartTheTests) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  EXPECT_TRUE(contains(folder.run({"--filter", "easy"}).output, "1 tests: 1 passed"));
  EXPECT_TRUE(contains(folder.run({"--filter", "s*e"}).output, "1 tests: 1 passed"));
  EXPECT_TRUE(contains(folder.run({"--filter", "easy", "--filter", "side"}).output, "2 tests: 2 passed"));
  const std::string first = folder.run({"--shard", "1/2"}).output, second = folder.run({"--shard", "2/2"}).output;
  EXPECT_TRUE(contains(first, "front") && !contains(first, "side")) << first;
  EXPECT_TRUE(contains(second, "side") && !contains(second, "front")) << second;
  EXPECT_EQ(folder.run({"--filter", "no"}).exit_code, 2);
  EXPECT_EQ(folder.run({"--update", "no"}).exit_code, 2);
  for (const char* shard : {"0/2", "3/2", "2", "1/2/3", "a/b"})
    EXPECT_EQ(folder.run({"--shard", shard}).exit_code, 2) << shard;
}

TEST(Check, TheTimeLimitEndsATest) {
  const CheckFolder folder;
  write_text(folder / "suite.toml",
             "[[test]]\nname = \"slow\"\nscene = \"square.gltf\"\nargs = [\"--spp\", \"1000000\"]\ntime_limit = 0.2\n");
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult result = folder.run();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.output, "its time limit is 0.2 s")) << result.output;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Check, AnInterruptKeepsWhatWasDone) {
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  write_text(folder / "suite.toml", std::string(suite_text) +
                                        "\n[[test]]\nname = \"slow\"\nscene = \"square.gltf\"\n"
                                        "args = [\"--spp\", \"1000000\"]\n");
  RunningProgram program({"check", "suite.toml", "--jobs", "1", "--junit", "out.xml"}, (folder / "").parent_path());
  ASSERT_TRUE(program.wait_for_output("side"));
  program.send(SIGINT);
  const ProgramResult result = program.wait();
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_TRUE(contains(result.output, "3 tests: 2 passed, 0 failed, 1 not run")) << result.output;
  EXPECT_TRUE(contains(read_text(folder / "out.xml"), "skipped=\"1\""));
  const auto json = nlohmann::json::parse(read_text(folder / "candil-check/results.json"));
  EXPECT_EQ(json.at("tests").size(), 2u);
}

// All that there is: passed, failed, broken, not run; and names and messages with markup, control characters and bytes
// that are no UTF-8.
TEST(Check, JUnitXmlKeepsToItsSchema) {
  if (std::system("xmllint --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no xmllint (libxml2-utils)";
  const CheckFolder folder;
  ASSERT_EQ(folder.run({"--update"}).exit_code, 0);
  write_text(folder / "suite.toml",
             std::string(suite_text) +
                 "\n[[test]]\nname = \"missing\"\nscene = \"<a> & 'b' \\\"c\\\" \\u0007 \\u00e9.gltf\"\n"
                 "[[test]]\nname = \"new\"\nscene = \"square.gltf\"\n");
  const ProgramResult result = folder.run({"--junit", "out.xml"});
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  const std::string xml = read_text(folder / "out.xml");
  EXPECT_TRUE(contains(xml, "tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"0\"")) << xml;
  EXPECT_TRUE(contains(xml, "&lt;a&gt; &amp; &#39;b&#39; &quot;c&quot; ?")) << xml;
  const std::string command = "xmllint --noout --schema '" CANDIL_SOURCE_DIR "/tests/cli/junit.xsd' '" +
                              (folder / "out.xml").string() + "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << xml;
}

TEST(Check, SomethingElseInPlaceOfTheGoldenImageIsAnError) {
  const CheckFolder folder;
  fs::create_directory(folder / "golden");
  write_text(folder / "golden/front.exr", "no image");
  write_image(folder / "golden/side.exr", Image(32, 32, 3), false, {});
  const ProgramResult result = folder.run();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.output, "no layer named variance")) << result.output;
  EXPECT_TRUE(contains(result.output, "2 tests: 0 passed, 2 failed")) << result.output;
}

}  // namespace
}  // namespace candil::test
