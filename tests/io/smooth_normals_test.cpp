/// Computed vertex normals against closed forms.
#include "io/smooth_normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/io/ply_sample.h"

namespace candil::test {
namespace {

PlyOptions smooth(float degrees) { return {NormalSource::smooth, glm::radians(degrees)}; }

/// Unit sphere of rings and segments. `is_open`: each face has corners of its own, as in triangle soups.
Mesh make_sphere(int rings, int segments, bool is_open) {
  Mesh mesh;
  const auto point = [&](int ring, int segment) {
    const float theta = pi * static_cast<float>(ring) / static_cast<float>(rings);
    const float phi = 2 * pi * static_cast<float>(segment % segments) / static_cast<float>(segments);
    const float sine = ring == 0 || ring == rings ? 0 : std::sin(theta);
    return Vec3(sine * std::cos(phi), std::cos(theta), sine * std::sin(phi));
  };
  for (int ring = 0; ring <= rings; ++ring)
    for (int segment = 0; segment <= segments; ++segment) mesh.positions.push_back(point(ring, segment));
  const auto id = [&](int ring, int segment) { return static_cast<std::uint32_t>(ring * (segments + 1) + segment); };
  for (int ring = 0; ring < rings; ++ring)
    for (int segment = 0; segment < segments; ++segment) {
      const std::uint32_t a = id(ring, segment), b = id(ring, segment + 1), c = id(ring + 1, segment + 1),
                          d = id(ring + 1, segment);
      if (ring > 0) mesh.triangles.emplace_back(a, b, c);
      if (ring + 1 < rings) mesh.triangles.emplace_back(a, c, d);
    }
  if (!is_open) return mesh;
  Mesh soup;
  for (const Triangle t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.triangles.emplace_back(first, first + 1, first + 2);
    for (int c = 0; c < 3; ++c) soup.positions.push_back(mesh.positions[t[c]]);
  }
  return soup;
}

// The normal of a sphere is its position. Seams and poles, where many vertices share a position, are no exception, nor
// is a soup. Rings and segments of 5.6 degrees; the mean of faces that lie unevenly around a vertex may be off by a
// fraction of that: 1 degree.
TEST(SmoothNormals, SphereIsItsPosition) {
  for (const bool is_open : {false, true}) {
    Mesh mesh = make_sphere(32, 64, is_open);
    const std::size_t count = mesh.positions.size();
    compute_smooth_normals(mesh, pi);
    ASSERT_EQ(mesh.positions.size(), count);  // nothing is sharp
    ASSERT_EQ(mesh.normals.size(), count);
    std::vector<bool> is_used(count);
    for (const Triangle t : mesh.triangles) is_used[t.x] = is_used[t.y] = is_used[t.z] = true;
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(glm::length(mesh.normals[i]), 1, 1e-5f);
      if (!is_used[i]) continue;
      EXPECT_GT(glm::dot(mesh.normals[i], mesh.positions[i]), std::cos(glm::radians(1.0f))) << i;
    }
  }
}

/// A cube of quads around the origin, corners at +-1.
std::string cube_ply() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  return ascii_ply(corners, {"4 0 2 3 1", "4 4 5 7 6", "4 0 1 5 4", "4 2 6 7 3", "4 0 4 6 2", "4 1 3 7 5"});
}

// The edges of a cube turn by 90 degrees: below, each face has its own normals; above, a corner gets the mean of its
// three faces, weighted by 90 degrees each however they are cut into triangles: the diagonal.
TEST(SmoothNormals, CreaseAngleOfACube) {
  const Mesh sharp = load_ply_text(cube_ply(), smooth(89));
  EXPECT_EQ(sharp.positions.size(), 24U);
  for (const Triangle t : sharp.triangles) {
    const Vec3 normal = glm::normalize(
        glm::cross(sharp.positions[t.y] - sharp.positions[t.x], sharp.positions[t.z] - sharp.positions[t.x]));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(glm::dot(sharp.normals[t[c]], normal), 1, 1e-6f);
  }
  const Mesh round = load_ply_text(cube_ply(), smooth(91));
  ASSERT_EQ(round.positions.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(glm::dot(round.normals[i], glm::normalize(round.positions[i])), 1, 1e-6f);
}

TEST(SmoothNormals, SourcesOfNormals) {
  const std::string with_normals = "ply\nformat ascii 1.0\n" + vertex_element(3) +
                                   "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
                                   "property list uchar int vertex_indices\nend_header\n"
                                   "0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n3 0 1 2\n";
  EXPECT_EQ(load_ply_text(with_normals).normals[0], Vec3(1, 0, 0));
  EXPECT_EQ(load_ply_text(with_normals, smooth(180)).normals[0], Vec3(0, 0, 1));
  EXPECT_TRUE(load_ply_text(with_normals, {NormalSource::flat, pi}).normals.empty());
  EXPECT_TRUE(load_ply_text(ascii_ply({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {"3 0 1 2"})).normals.empty());
}

// Two faces with the same corners and opposite fronts leave no mean; an empty triangle has no normal to give.
TEST(SmoothNormals, SheetsAndEmptyTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {3, 3, 3}, {0, 0, 1}};
  compute_smooth_normals(mesh, pi);
  ASSERT_EQ(mesh.positions.size(), 4U);
  for (const Vec3 normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1, 1e-6f);
  EXPECT_NEAR(std::abs(mesh.normals[0].z), 1, 1e-6f);
}

// Attributes go along with the doubled vertices of a sharp edge.
TEST(SmoothNormals, DoubledVerticesKeepTheirAttributes) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}};  // turn by 90 degrees at the edge from 0 to 1
  mesh.uvs[0] = {{0, 0}, {0, 1}, {1, 0}, {2, 0}};
  mesh.colors = {Vec4(0.1f), Vec4(0.2f), Vec4(0.3f), Vec4(0.4f)};
  compute_smooth_normals(mesh, glm::radians(45.0f));
  ASSERT_EQ(mesh.positions.size(), 6U);
  for (const Triangle t : mesh.triangles) {
    EXPECT_EQ(mesh.positions[t.x], Vec3(0));
    EXPECT_EQ(mesh.uvs[0][t.x], Vec2(0));
    EXPECT_EQ(mesh.colors[t.x], Vec4(0.1f));
  }
  EXPECT_NEAR(mesh.normals[mesh.triangles[0].x].z, 1, 1e-6f);
  EXPECT_NEAR(std::abs(mesh.normals[mesh.triangles[1].x].x), 1, 1e-6f);
}

}  // namespace
}  // namespace candil::test
