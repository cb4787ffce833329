/// The project's own suite of images (scenes/suite.toml): that it is sensitive. Every small fault must be caught, in an
/// altered scene or in a program with a mistake in its source (candil_fault in tests/CMakeLists.txt). That it passes is
/// the CTest test `suite`.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

const std::string scenes_folder = CANDIL_SCENES_DIR;

/// Names of the tests by what became of them: "passed", "failed", "error".
std::map<std::string, std::string> statuses(const std::filesystem::path& folder) {
  std::map<std::string, std::string> found;
  const auto json = nlohmann::json::parse(read_text(folder / "results.json"));
  for (const auto& [name, value] : json.at("tests").items()) found[name] = value.at("status");
  return found;
}

TEST(Suite, CatchesEveryFaultOfAScene) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_program({"check", scenes_folder + "/must_fail.toml", "--output", "out"}, folder.path());
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  const auto found = statuses(folder / "out");
  EXPECT_EQ(found.size(), 10u);
  for (const auto& [name, status] : found) EXPECT_EQ(status, "failed") << name << " was not caught\n" << result.output;
}

struct Fault {
  const char* name;
  std::vector<std::string> caught_by;  // tests of the suite
};

void PrintTo(const Fault& fault, std::ostream* stream) { *stream << fault.name; }

class SuiteCatches : public testing::TestWithParam<Fault> {};

TEST_P(SuiteCatches, AMistakeInTheSource) {
  const TemporaryFolder folder;
  std::vector<std::string> words = {"check", scenes_folder + "/suite.toml", "--output", "out"};
  for (const std::string& name : GetParam().caught_by) words.insert(words.end(), {"--filter", name});
  const std::string program = std::string(CANDIL_FAULTS_DIR) + "/candil_fault_" + GetParam().name;
  const ProgramResult result = run_program(words, folder.path(), program);
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  for (const auto& [name, status] : statuses(folder / "out")) EXPECT_EQ(status, "failed") << name << result.output;
}

const Fault faults[] = {
    {"bright_closure", {"closure_phong"}},
    {"missing_cosine", {"closure_phong", "fig21c_phong_250"}},
    {"no_mis_weight", {"closure_lambertian", "light_constant", "gltf_cornell"}},
    {"srgb_by_gamma", {"texture_nearest", "texture_bilinear"}},
    {"shifted_texel", {"texture_nearest"}},
};

INSTANTIATE_TEST_SUITE_P(All, SuiteCatches, testing::ValuesIn(faults),
                         [](const auto& fault) { return fault.param.name; });

}  // namespace
}  // namespace candil::test
