/// Suites that cannot be used: one line that names file, line and key, and exit code 3.
#include <gtest/gtest.h>

#include <ostream>

#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

struct BadSuite {
  const char* name;
  const char* text;
  const char* message;  // what comes after "error: "
};

void PrintTo(const BadSuite& suite, std::ostream* stream) { *stream << suite.name; }

const BadSuite bad_suites[] = {
    {"NotToml", "[[test]\n", "suite.toml:1: "},
    {"NoTest", "[defaults]\n", "suite.toml:1: has no [[test]]"},
    {"TestIsATable", "[test]\nname = \"a\"\n", "suite.toml:1: test: must be written as [[test]]"},
    {"UnknownRootKey", "seed = 1\n[[test]]\nname = \"a\"\nscene = \"a.gltf\"\n",
     "suite.toml:1: seed: is not known; known are defaults, test"},
    {"UnknownKey", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\nspp = 4\n", "suite.toml:4: test[0].spp: is not known"},
    {"NoName", "[[test]]\nscene = \"a.gltf\"\n", "suite.toml:1: test[0]: has no name"},
    {"NoScene", "[[test]]\nname = \"a\"\n", "suite.toml:1: test[0]: has no scene"},
    {"BadName", "[[test]]\nname = \"../a\"\nscene = \"a.gltf\"\n", "suite.toml:2: test[0].name: '../a': a name is"},
    {"NameTwice", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\n[[test]]\nname = \"a\"\nscene = \"a.gltf\"\n",
     "suite.toml:5: test[1].name: 'a' is the name of test[0] too"},
    {"WrongType", "[[test]]\nname = 1\nscene = \"a.gltf\"\n", "suite.toml:2: test[0].name: must be text"},
    {"ArgsNoList", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\nargs = \"--spp 4\"\n",
     "suite.toml:4: test[0].args: must be a list of texts"},
    {"BadArgs", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\nargs = [\"--spp\", \"0\"]\n",
     "suite.toml:4: test[0].args: --spp: "},
    {"ArgsWithOutput", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\nargs = [\"-o\", \"a.png\"]\n",
     "suite.toml:4: test[0].args: --output is not for suites"},
    {"SceneOutside", "[[test]]\nname = \"a\"\nscene = \"../a.gltf\"\n",
     "suite.toml:3: test[0].scene: ../a.gltf: must stay in the folder"},
    {"SceneAbsolute", "[[test]]\nname = \"a\"\nscene = \"/a.gltf\"\n",
     "suite.toml:3: test[0].scene: /a.gltf: must be a path relative"},
    {"EnvironmentOutside", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\nargs = [\"--env\", \"../a.hdr\"]\n",
     "suite.toml:4: test[0].args: ../a.hdr: must stay in the folder"},
    {"GoldenNoExr", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\ngolden = \"a.png\"\n",
     "suite.toml:4: test[0].golden: must be an .exr file"},
    {"TimeOutOfRange", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\ntime_limit = -1\n",
     "suite.toml:4: test[0].time_limit: must be a number from 0.001"},
    {"TimeNaN", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\ntime_limit = nan\n",
     "suite.toml:4: test[0].time_limit: must be a number"},
    {"UnknownMetric", "[[test]]\nname = \"a\"\nscene = \"a.gltf\"\nthreshold = { flop = 1 }\n",
     "suite.toml:4: test[0].threshold.flop: is no metric"},
    {"PValueOutOfRange", "[defaults]\nthreshold = { ztest = 2 }\n[[test]]\nname = \"a\"\nscene = \"a.gltf\"\n",
     "suite.toml:2: defaults.threshold.ztest: must be a number from 0 to 1"},
};

class BadSuites : public testing::TestWithParam<BadSuite> {};

TEST_P(BadSuites, AreOneLineWithThePlace) {
  const TemporaryFolder folder;
  write_text(folder / "suite.toml", GetParam().text);
  const ProgramResult result = run_program({"check", "suite.toml"}, folder.path());
  EXPECT_EQ(result.exit_code, 3) << result.errors;
  EXPECT_EQ(count_errors(result), 1);
  EXPECT_TRUE(result.errors.starts_with(std::string("error: ") + GetParam().message)) << result.errors;
  EXPECT_EQ(folder.names(), std::vector<std::string>{"suite.toml"});
}

INSTANTIATE_TEST_SUITE_P(All, BadSuites, testing::ValuesIn(bad_suites),
                         [](const auto& suite) { return suite.param.name; });

TEST(SuiteFile, ALinkDoesNotLeadOut) {
  const TemporaryFolder outside, folder;
  write_square_scene(outside);
  std::filesystem::create_directory_symlink(outside.path(), folder / "models");
  write_text(folder / "suite.toml", "[[test]]\nname = \"a\"\nscene = \"models/square.gltf\"\n");
  const ProgramResult result = run_program({"check", "suite.toml"}, folder.path());
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.errors.find("a link leads out"), std::string::npos) << result.errors;
}

TEST(SuiteFile, IsNeeded) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_program({"check"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run_program({"check", "none.toml"}, folder.path()).exit_code, 3);
  EXPECT_EQ(run_program({"check", "."}, folder.path()).exit_code, 3);
}

}  // namespace
}  // namespace candil::test
