/// PLY files on the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/image_file.h"
#include "tests/cli/run_program.h"

namespace candil::test {
namespace {

const std::string header =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string square = header + "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3\n";

// Told by its first bytes, whatever it is called; framed, and lit by the studio.
TEST(Ply, Renders) {
  const TemporaryFolder folder;
  for (const std::string name : {"square.ply", "square.mesh"}) {
    write_text(folder / name, square);
    const ProgramResult result =
        run_program({name, "-o", "a.pfm", "--size", "16x16", "--spp", "4", "--integrator", "albedo"}, folder.path());
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.errors.find("warning"), std::string::npos) << result.errors;
    // The middle of the picture is the default material: grey, 0.5.
    const Image image = read_image(folder / "a.pfm");
    EXPECT_NEAR(image.pixels[3 * (8 * 16 + 8)], 0.5f, 1e-3f);
  }
}

TEST(Ply, InfoCounts) {
  const TemporaryFolder folder;
  write_text(folder / "square.ply", square);
  const ProgramResult result = run_program({"info", "--json", "square.ply"}, folder.path());
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const nlohmann::json json = nlohmann::json::parse(result.output);
  EXPECT_EQ(json.at("triangles"), 2);
  EXPECT_EQ(json.at("vertices"), 4);
  EXPECT_EQ(json.at("materials"), 1);
  EXPECT_EQ(json.at("bounds").at("high"), (nlohmann::json{1.0, 1.0, 0.0}));
}

TEST(Ply, MistakesGiveThreeAndNameThePlace) {
  const TemporaryFolder folder;
  write_text(folder / "empty.ply", "");
  write_text(folder / "short.ply", header + "-1 -1 0\n1 -1 0\n1 1 0\n");
  write_text(folder / "index.ply", header + "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 4\n");
  for (const auto& [name, message] :
       {std::pair("none.ply", "error: none.ply: the file does not exist\n"),
        std::pair("empty.ply", "error: empty.ply: is empty\n"),
        std::pair("short.ply", "error: short.ply: element vertex: claims 4 rows, the file has bytes for 3 at most\n"),
        std::pair("index.ply", "error: index.ply: element face, row 0: vertex 4 is out of range, there are 4\n")}) {
    const ProgramResult result = run_program({name, "-o", "a.png"}, folder.path());
    EXPECT_EQ(result.exit_code, 3) << name;
    EXPECT_EQ(result.errors, message);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png")) << name;
  }
}

TEST(Ply, PointsAloneRenderNothingWithAWarning) {
  const TemporaryFolder folder;
  write_text(folder / "points.ply",
             header.substr(0, header.find("element face")) + "end_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  const ProgramResult result = run_program({"points.ply", "-o", "a.png", "--size", "4x4", "--spp", "1"}, folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.errors.find("warning: the file has no faces, nothing of it is shown\n"), std::string::npos)
      << result.errors;
  EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
}

}  // namespace
}  // namespace candil::test
