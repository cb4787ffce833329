/// Broken and hostile PLY files: one line that names the place, and no memory by what a header claims.
#include <gtest/gtest.h>

#include "tests/io/ply_sample.h"

namespace candil::test {
namespace {

struct BrokenPly {
  std::string text, message;
};

void PrintTo(const BrokenPly& broken, std::ostream* out) { *out << broken.message; }

class PlyError : public testing::TestWithParam<BrokenPly> {};

TEST_P(PlyError, NamesThePlace) { EXPECT_EQ(ply_error(GetParam().text), "mesh.ply: " + GetParam().message); }

std::string with_header(const std::string& lines) { return "ply\nformat ascii 1.0\n" + lines + "end_header\n"; }

const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
const std::vector<Vec3> three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

INSTANTIATE_TEST_SUITE_P(
    Header, PlyError,
    testing::Values(
        BrokenPly{"", "is empty"}, BrokenPly{"plyx\n", "header, line 1: does not begin with \"ply\""},
        BrokenPly{"ply\n", "header: has no end_header"}, BrokenPly{"ply\nend_header\n", "header: has no format"},
        BrokenPly{"ply\nformat ascii 2.0\n", "header, line 2: version \"2.0\" is unknown, only 1.0 is"},
        BrokenPly{"ply\nformat binary_middle_endian 1.0\n",
                  "header, line 2: format \"binary_middle_endian\" is unknown"},
        BrokenPly{"ply\nformat ascii 1.0\nformat ascii 1.0\n", "header, line 3: the format is given twice"},
        BrokenPly{with_header("property float x\n"), "header, line 3: a property comes before the first element"},
        BrokenPly{with_header("element vertex -1\n"), "header, line 3: \"-1\" is no number of rows"},
        BrokenPly{with_header("element vertex 99999999999999999999\n"),
                  "header, line 3: \"99999999999999999999\" is no number of rows"},
        BrokenPly{with_header("element vertex\n"), "header, line 3: \"\" is no number of rows"},
        BrokenPly{with_header("element vertex 0\nelement vertex 0\n"),
                  "header, line 4: element \"vertex\" is there twice"},
        BrokenPly{with_header("element vertex 1\nproperty real x\n"), "header, line 4: \"real\" is no type"},
        BrokenPly{with_header("element vertex 1\nproperty list float int x\n"),
                  "header, line 4: the length of a list must be an integer"},
        BrokenPly{with_header("element vertex 1\nproperty float\n"), "header, line 4: a property has no name"},
        BrokenPly{with_header("element face 0\n"), "header: has no element vertex"},
        BrokenPly{with_header("element vertex 1000\n" + face) + "3 0 1 2\n", "element vertex: has no property x"},
        BrokenPly{with_header(vertex_element(0) + "element face 1\n"), "element face: has no list vertex_indices"},
        BrokenPly{with_header("element vertex 1\nproperty float x\nproperty float z\n") + "0 0\n",
                  "element vertex: has no property y"},
        BrokenPly{with_header(vertex_element(0) + "element face 1\nproperty int material\n") + "0\n",
                  "element face: has no list vertex_indices"}));

INSTANTIATE_TEST_SUITE_P(
    Rows, PlyError,
    testing::Values(BrokenPly{ascii_ply(three, {"3 0 1 3"}),
                              "element face, row 0: vertex 3 is out of range, there are 3"},
                    BrokenPly{ascii_ply(three, {"3 0 1 2", "3 0 -1 2"}),
                              "element face, row 1: vertex -1 is out of range, there are 3"},
                    BrokenPly{ascii_ply(three, {"3 0 1 4294967295"}),
                              "element face, row 0: vertex 4294967295 is out of range, there are 3"},
                    BrokenPly{ascii_ply(three, {"-3 0 1 2"}), "element face, row 0: a list has -3 values"},
                    BrokenPly{ascii_ply(three, {"4000000000 0 1 2"}),
                              "element face, row 0: a list claims 4000000000 values, the file has not that many left"},
                    BrokenPly{ascii_ply(three, {"3 0 1"}), "element face, row 0: the file ends here"},
                    BrokenPly{ascii_ply(three, {"3 0 1 1.5"}), "element face, row 0: a value must be an integer"},
                    BrokenPly{ascii_ply(three, {"3 0 1 two"}), "element face, row 0: \"two\" is not a number"},
                    BrokenPly{ascii_ply(three, {"3 0 1 nan"}), "element face, row 0: a value must be an integer"},
                    BrokenPly{with_header(vertex_element(3) + face) + "0 0 0\n1 0 1e400\n0 1 0\n3 0 1 2\n",
                              "element vertex, row 1: the position is not finite"},
                    BrokenPly{with_header(vertex_element(3) + face) + "0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n",
                              "element vertex, row 2: the position is not finite"},
                    BrokenPly{with_header(vertex_element(3) + face) + "0 0 0\n1 0 0\n0 2e9 0\n3 0 1 2\n",
                              "element vertex, row 2: the position is farther than 1e9 m from the origin"},
                    BrokenPly{with_header(vertex_element(3) + face) + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n",
                              "element vertex, row 1: \"x\" is not a number"}));

// A header of 4e9 rows costs no memory: it is compared with the bytes behind it first.
INSTANTIATE_TEST_SUITE_P(
    Lies, PlyError,
    testing::Values(
        BrokenPly{with_header(vertex_element(4000000000)) + "0 0 0\n",
                  "element vertex: claims 4000000000 rows, the file has bytes for 1 at most"},
        BrokenPly{PlySample("binary_little_endian", vertex_element(4000000000)).values("float", {0, 0, 0, 1}).text(),
                  "element vertex: claims 4000000000 rows, the file has bytes for 1 at most"},
        BrokenPly{with_header("element face 18446744073709551615\nproperty list uchar int vertex_indices\n" +
                              vertex_element(3)),
                  "element face: claims 18446744073709551615 rows, the file has bytes for 0 at most"},
        BrokenPly{with_header("element vertex 4294967295\n"), "element vertex: has too many rows"},
        BrokenPly{PlySample("binary_big_endian",
                            vertex_element(0) + "element face 1\nproperty list uint double vertex_indices\n")
                      .value("uint", 4e9)
                      .text(),
                  "element face, row 0: a list claims 4000000000 values, the file has not that many left"},
        BrokenPly{
            PlySample("binary_little_endian", vertex_element(0) + "element junk 1\nproperty list char double more\n")
                .value("char", -1)
                .text(),
            "element junk, row 0: a list has -1 values"}));

// An element without properties has rows of no bytes at all.
TEST(PlyHostile, RowsWithoutBytesTakeNoTime) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(load_ply_text(with_header("element nothing 18446744073709551615\n" + vertex_element(0)), warnings)
                  .triangles.empty());
}

TEST(PlyHostile, ElementsAreLimited) {
  std::string elements;
  for (int i = 0; i < 1000; ++i) elements += "element e" + std::to_string(i) + " 0\n";
  // Two lines come before the first element.
  EXPECT_EQ(ply_error(with_header(elements + "element last 0\n")),
            "mesh.ply: header, line 1003: there are more than 1000 elements");
}

TEST(PlyHostile, UnknownLinesAreOneWarning) {
  std::vector<std::string> warnings;
  load_ply_text(with_header(vertex_element(0) + "junk 1\njunk 2\nother\n"), warnings);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{"header, line 7: \"junk\" is no keyword, ignored, and so are 2 more lines",
                                      "the file has no faces, nothing of it is shown"}));
}

// Cutting a file short anywhere gives a message, never a crash.
TEST(PlyHostile, TruncatedFiles) {
  for (const std::string& format : ply_formats) {
    PlySample sample(format, vertex_element(3) + face);
    sample.values("float", {0, 0, 0})
        .end_row()
        .values("float", {1, 0, 0})
        .end_row()
        .values("float", {0, 1, 0})
        .end_row();
    const std::string whole = sample.list("uchar", "int", {0, 1, 2}).text();
    ASSERT_EQ(ply_error(whole), "");
    // The last value of an ascii file ends in a blank.
    for (std::size_t length = 0; length + (format == "ascii" ? 2 : 1) <= whole.size(); ++length)
      EXPECT_NE(ply_error(whole.substr(0, length)), "") << format << length;
  }
}

}  // namespace
}  // namespace candil::test
