/// What PLY files become: every format and type, polygons, strips, attributes.
#include "io/ply.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/color.h"
#include "tests/io/ply_sample.h"

namespace candil::test {
namespace {

const std::vector<std::string> number_types = {"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                               "float", "double", "int8",    "uint8",  "int16", "uint16",
                                               "int32", "uint32", "float32", "float64"};
const std::string integer_types[] = {"char", "uchar", "short", "ushort", "int", "uint", "int8", "uint32"};

const std::vector<Vec3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

double area(const Mesh& mesh) {
  double sum = 0;
  for (const Triangle t : mesh.triangles)
    sum += 0.5 * glm::length(
                     glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
  return sum;
}

// Positions are small integers, so that every type holds them.
TEST(Ply, EveryFormatAndTypeOfPosition) {
  for (const std::string& format : ply_formats)
    for (const std::string& type : number_types) {
      PlySample sample(format, vertex_element(3, type) + "element face 1\nproperty list uchar int vertex_indices\n");
      sample.values(type, {1, 2, 3}).end_row().values(type, {4, 5, 6}).end_row().values(type, {7, 8, 100}).end_row();
      sample.list("uchar", "int", {2, 0, 1}).end_row();
      const Mesh mesh = load_ply_text(sample.text());
      ASSERT_EQ(mesh.positions, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 100}})) << format << type;
      ASSERT_EQ(mesh.triangles, std::vector<Triangle>{Triangle(2, 0, 1)}) << format << type;
    }
}

TEST(Ply, EveryFormatAndTypeOfLists) {
  for (const std::string& format : ply_formats)
    for (const std::string& count_type : integer_types)
      for (const std::string& type : number_types) {
        PlySample sample(
            format, vertex_element(4) + "element face 2\nproperty list " + count_type + " " + type + " vertex_index\n");
        for (const Vec3 p : square) sample.values("float", {p.x, p.y, p.z}).end_row();
        sample.list(count_type, type, {0, 1, 2, 3}).end_row().list(count_type, type, {3, 1, 0}).end_row();
        const Mesh mesh = load_ply_text(sample.text());
        ASSERT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 1, 0}}))
            << format << count_type << type;
      }
}

// What candil does not know stands before, between and behind what it does, lists included.
TEST(Ply, SkipsWhatItDoesNotKnow) {
  for (const std::string& format : ply_formats) {
    PlySample sample(format,
                     "comment made by a test\nobj_info nothing\nelement camera 2\nproperty list ushort double view\n"
                     "property char c\nelement vertex 3\nproperty list uchar short tags\nproperty double y\n"
                     "property uchar q\nproperty float x\nproperty float z\nproperty list int float more\n"
                     "element face 1\nproperty int material\nproperty list uchar float weights\n"
                     "property list uchar uint vertex_indices\nproperty list uchar uchar flags\n"
                     "element tail 1\nproperty double d\n");
    for (const double n : {2, 0})
      sample.list("ushort", "double", std::vector<double>(n, 0.5)).value("char", -1).end_row();
    for (const double n : {0, 1, 2})
      sample.list("uchar", "short", std::vector<double>(n, 300))
          .value("double", 10 + n)
          .value("uchar", 255)
          .values("float", {20 + n, n * n})
          .list("int", "float", std::vector<double>(n, 0.25))
          .end_row();
    sample.value("int", 7)
        .list("uchar", "float", {1, 2})
        .list("uchar", "uint", {0, 1, 2})
        .list("uchar", "uchar", {})
        .end_row();
    sample.value("double", 3).end_row();
    const Mesh mesh = load_ply_text(sample.text());
    EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{20, 10, 0}, {21, 11, 1}, {22, 12, 4}})) << format;
    EXPECT_EQ(mesh.triangles, std::vector<Triangle>{Triangle(0, 1, 2)}) << format;
  }
}

TEST(Ply, FacesMayComeFirst) {
  const Mesh mesh = load_ply_text("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n" +
                                  vertex_element(3) + "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_EQ(mesh.triangles.size(), 1U);
}

TEST(Ply, EndsOfLines) {
  const std::string text = ascii_ply(square, {"4 0 1 2 3"});
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(load_ply_text(other).triangles.size(), 2U);
  }
}

// With bare CR in the header, a first byte of 10 is data; with LF, a first byte of 10 or 13 is.
TEST(Ply, DataThatLooksLikeEndsOfLines) {
  for (const std::string end : {"\n", "\r", "\r\n"})
    for (const char first : {'\n', '\r'}) {
      std::string text = "ply\nformat binary_big_endian 1.0\nelement tag 1\nproperty uchar t\n" + vertex_element(3) +
                         "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
      std::string header;
      for (const char c : text) header += c == '\n' ? end : std::string(1, c);
      const std::string rows = PlySample("binary_big_endian", "")
                                   .values("float", {0, 0, 0, 1, 0, 0, 0, 1, 0})
                                   .list("uchar", "uchar", {0, 1, 2})
                                   .text();
      const std::string data = rows.substr(rows.find("end_header\n") + 11);
      EXPECT_EQ(load_ply_text(header + first + data).positions[1], Vec3(1, 0, 0)) << int(first) << int(end[0]);
    }
}

// Concave ones too: the triangles cover the outline's area once, whichever corner comes first.
TEST(Ply, PolygonsOfAnyShape) {
  const std::vector<std::vector<Vec3>> outlines = {
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}},                                              // arrow: 8 - 2
      {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},                        // an L: 5
      {{0, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}, {4, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}},  // a U: 9
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}}};  // square, a corner amid: 4
  const double areas[] = {6, 5, 9, 4};
  for (std::size_t o = 0; o < outlines.size(); ++o)
    for (std::size_t first = 0; first < outlines[o].size(); ++first)
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<Vec3> corners;
        std::string face = std::to_string(outlines[o].size());
        for (std::size_t i = 0; i < outlines[o].size(); ++i) {
          const Vec3 p = outlines[o][(first + i) % outlines[o].size()];
          corners.push_back(axis == 0 ? p : axis == 1 ? Vec3(p.z, p.x, p.y) : Vec3(p.x, -p.z, p.y));
          face += " " + std::to_string(i);
        }
        const Mesh mesh = load_ply_text(ascii_ply(corners, {face}));
        EXPECT_EQ(mesh.triangles.size(), corners.size() - 2);
        EXPECT_NEAR(area(mesh), areas[o], 1e-5) << o << " from " << first;
      }
}

// A bow tie.
TEST(Ply, PolygonsThatCrossThemselvesAreAWarning) {
  std::vector<std::string> warnings;
  const Mesh mesh =
      load_ply_text(ascii_ply({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, {"4 0 1 2 3", "2 0 1"}), warnings);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(warnings, (std::vector<std::string>{
                          "element face: 1 faces with fewer than 3 corners are left out",
                          "element face: 1 faces cross themselves or are too intricate, they are shown roughly"}));
}

// A pentagram turns left at each corner, but goes round twice.
TEST(Ply, PentagramsCrossThemselves) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 5; ++i) corners.emplace_back(std::cos(0.8f * pi * i), std::sin(0.8f * pi * i), 0);
  std::vector<std::string> warnings;
  EXPECT_EQ(load_ply_text(ascii_ply(corners, {"5 0 1 2 3 4"}), warnings).triangles.size(), 3U);
  EXPECT_EQ(warnings, std::vector<std::string>{
                          "element face: 1 faces cross themselves or are too intricate, they are shown roughly"});
  // The same corners in the order of a pentagon.
  EXPECT_EQ(load_ply_text(ascii_ply(corners, {"5 0 3 1 4 2"})).triangles.size(), 3U);
}

// Two strips in one row, as in Stanford's files, and one in the next. Odd triangles turn round.
TEST(Ply, TriangleStrips) {
  for (const std::string& format : ply_formats) {
    PlySample sample(format, vertex_element(4) + "element tristrips 2\nproperty list int int vertex_indices\n");
    for (const Vec3 p : square) sample.values("float", {p.x, p.y, p.z}).end_row();
    sample.list("int", "int", {0, 1, 3, 2, -1, 3, 1, 0, -1}).end_row().list("int", "int", {1, 2, 3}).end_row();
    EXPECT_EQ(load_ply_text(sample.text()).triangles,
              (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}, {3, 1, 0}, {1, 2, 3}}))
        << format;
  }
}

TEST(Ply, AttributesOfVertices) {
  for (const auto& [u, v] : {std::pair("u", "v"), std::pair("s", "t"), std::pair("texture_u", "texture_v"),
                             std::pair("texture_s", "texture_t")}) {
    PlySample sample("binary_little_endian",
                     vertex_element(3) + "property float ny\nproperty float nx\nproperty float nz\nproperty float " +
                         u + "\nproperty double " + v +
                         "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
                         "element face 1\nproperty list uchar int vertex_indices\n");
    for (const double i : {0, 1, 2})
      sample.values("float", {i, i * i, 0, 0, 0, 2, 0.25 * i})
          .value("double", 0.125)
          .values("uchar", {128, 0, 255, 51});
    sample.list("uchar", "int", {0, 1, 2});
    const Mesh mesh = load_ply_text(sample.text());
    EXPECT_EQ(mesh.normals, std::vector<Vec3>(3, Vec3(0, 0, 1)));                         // made a unit vector
    EXPECT_EQ(mesh.uvs[0].at(2), Vec2(0.5f, 0.875f)) << u;                                // v grows upwards in PLY
    EXPECT_EQ(mesh.colors.at(0), Vec4(srgb_to_linear(128 / 255.0f), 0, 1, 51 / 255.0f));  // alpha is no colour
  }
}

TEST(Ply, FloatColoursAreLinear) {
  const std::string header = "ply\nformat ascii 1.0\n" + vertex_element(3) +
                             "property float red\nproperty float green\nproperty float blue\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const Mesh mesh = load_ply_text(header + "0 0 0 .5 .25 1\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n");
  EXPECT_EQ(mesh.colors[0], Vec4(0.5f, 0.25f, 1, 1));
  std::vector<std::string> warnings;
  EXPECT_EQ(load_ply_text(header + "0 0 0 -1 nan 3\n1 0 0 0 0 0\n0 1 0 0 0 0\n3 0 1 2\n", warnings).colors[0],
            Vec4(0, 0, 1, 1));
  EXPECT_EQ(warnings, std::vector<std::string>{"element vertex: has colours out of range, they are clamped"});
}

// Two triangles share an edge; at vertex 2 they disagree about the texture, at vertex 0 they do not.
TEST(Ply, TextureCoordinatesOfFaces) {
  const Mesh mesh = load_ply_text("ply\nformat ascii 1.0\n" + vertex_element(4) +
                                  "element face 2\nproperty list uchar int vertex_indices\n"
                                  "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                  "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0 0 .5 .5 0 1\n");
  ASSERT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.triangles[0].x, mesh.triangles[1].x);
  EXPECT_NE(mesh.triangles[0].z, mesh.triangles[1].y);
  EXPECT_EQ(mesh.positions[mesh.triangles[1].y], Vec3(1, 1, 0));
  EXPECT_EQ(mesh.uvs[0][mesh.triangles[0].z], Vec2(1, 0));
  EXPECT_EQ(mesh.uvs[0][mesh.triangles[1].y], Vec2(0.5f, 0.5f));
}

TEST(Ply, VerticesWithoutFacesAreLeftOut) {
  const Mesh mesh = load_ply_text(ascii_ply({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"3 1 2 3"}));
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(Ply, PointsAloneAreAWarning) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(
      load_ply_text("ply\nformat ascii 1.0\n" + vertex_element(1) + "end_header\n1 2 3\n", warnings).triangles.empty());
  EXPECT_EQ(warnings, std::vector<std::string>{"the file has no faces, nothing of it is shown"});
}

TEST(Ply, UnusableNormalsAreReplaced) {
  std::vector<std::string> warnings;
  const Mesh mesh = load_ply_text("ply\nformat ascii 1.0\n" + vertex_element(3) +
                                      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
                                      "property list uchar int vertex_indices\nend_header\n"
                                      "0 0 0 0 0 0\n1 0 0 nan 0 1\n0 1 0 1 0 0\n3 0 1 2\n",
                                  warnings);
  EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(warnings, std::vector<std::string>{
                          "element vertex: has normals without a direction, those of the triangles are used"});
}

TEST(Ply, LongRowsAndMoreDataAreWarnings) {
  std::vector<std::string> warnings;
  const std::string text = ascii_ply({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"3 0 1 2 17"}) + "rest\n";
  EXPECT_EQ(load_ply_text(text, warnings).triangles.size(), 1U);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{"element face: 1 rows have more values than the header tells, they are ignored",
                                      "the file has more data than its header tells, it is ignored"}));
}

}  // namespace
}  // namespace candil::test
