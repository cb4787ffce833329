#include "io/tangents.h"

#include <gtest/gtest.h>

#include <cmath>

namespace candil {
namespace {

/// The unit square in z = 0 facing +Z, two triangles, uvs as an affine map of (x, y) with v pointing down where y
/// points up: for the identity, u = x and v = 1 - y.
Mesh make_square(Vec3 row_u, Vec3 row_v) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(4, Vec3(0, 0, 1));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Vec3 p : mesh.positions) {
    mesh.uvs[0].push_back({glm::dot(row_u, Vec3(p.x, p.y, 1)), glm::dot(row_v, Vec3(p.x, p.y, 1))});
  }
  return mesh;
}

void expect_tangents(const Mesh& mesh, Vec4 expected) {
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  for (const Vec4 tangent : mesh.tangents) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(tangent[c], expected[c], 1e-6f);
  }
}

// u grows along +X; the image's "up" (decreasing v) is +Y = +1 cross(+Z, +X).
TEST(Tangents, FollowU) {
  Mesh mesh = make_square({1, 0, 0}, {0, -1, 1});
  generate_tangents(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 4u);
  expect_tangents(mesh, {1, 0, 0, 1});
}

// u = x cos a + y sin a grows along (cos a, sin a); v = 1 + x sin a - y cos a is the rotation that goes with it.
TEST(Tangents, TurnWithRotatedUvs) {
  for (const float a : {0.3f, 1.2f, 2.9f, -2.0f}) {
    Mesh mesh = make_square({std::cos(a), std::sin(a), 0}, {std::sin(a), -std::cos(a), 1});
    generate_tangents(mesh, 0);
    expect_tangents(mesh, {std::cos(a), std::sin(a), 0, 1});
  }
}

// u = -x: the tangent is -X, and "up" is +Y = -1 cross(+Z, -X). v = y alone mirrors too: "up" is -Y = -1 cross(+Z, +X).
TEST(Tangents, MirroredUvsGetNegativeW) {
  Mesh mirrored_u = make_square({-1, 0, 1}, {0, -1, 1});
  generate_tangents(mirrored_u, 0);
  expect_tangents(mirrored_u, {-1, 0, 0, -1});
  Mesh mirrored_v = make_square({1, 0, 0}, {0, 1, 0});
  generate_tangents(mirrored_v, 0);
  expect_tangents(mirrored_v, {1, 0, 0, -1});
}

// Scaling the two directions differently (here also skewing) changes neither: u grows along the projection of its
// gradient's dual, dP/du. With u = 2 x, v = 1 - x - 3 y: P(u, v) = (u / 2, (1 - v - u / 2) / 3), dP/du = (1/2, -1/6).
TEST(Tangents, AreTheDerivativeOfThePositionByU) {
  Mesh mesh = make_square({2, 0, 0}, {-1, -3, 1});
  generate_tangents(mesh, 0);
  const Vec3 expected = glm::normalize(Vec3(0.5f, -1 / 6.0f, 0));
  expect_tangents(mesh, Vec4(expected, 1));
}

// Two triangles share an edge; the second one's uvs are mirrored about it. Its two vertices are split, with the
// tangents (1, 0, 0, 1) and (-1, 0, 0, -1).
TEST(Tangents, SplitVerticesBetweenMirroredTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  mesh.normals.assign(4, Vec3(0, 0, 1));
  mesh.uvs[0] = {{0, 1}, {0, 0}, {1, 1}, {1, 1}};
  mesh.colors = {Vec4(0), Vec4(0.1f), Vec4(0.2f), Vec4(0.3f)};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  generate_tangents(mesh, 0);
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.normals.size(), 6u);
  EXPECT_EQ(mesh.uvs[0].size(), 6u);
  EXPECT_EQ(mesh.colors.size(), 6u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(mesh.tangents[mesh.triangles[0][c]], Vec4(-1, 0, 0, -1));
    EXPECT_EQ(mesh.tangents[mesh.triangles[1][c]], Vec4(1, 0, 0, 1));
  }
  for (int v = 4; v < 6; ++v) {  // copies of vertices 0 and 1
    const int original = mesh.positions[v].y == 0 ? 0 : 1;
    EXPECT_EQ(mesh.positions[v], mesh.positions[original]);
    EXPECT_EQ(mesh.colors[v], mesh.colors[original]);
  }
}

// A vertex at the origin with normal +Z, where triangle A has a corner of 90 degrees and u along +X, and triangle B one
// of 45 degrees and u along +Y. Weighted by the angles the direction is (90, 45) / |(90, 45)| = (2, 1) / sqrt(5). They
// do not share an edge direction in uv, only the corner: uv (0, 0) there in both.
TEST(Tangents, AverageByAngle) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.normals.assign(5, Vec3(0, 0, 1));
  // A: (0 0), (1 0), (0 1) in the plane has uvs u = x, v = -y. B: (0 0), (-1 0), (-1 -1) has u = y, v = x: dP/du = +Y,
  // "up" = -dP/dv = -X = cross(+Z, +Y).
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, -1}, {0, -1}, {-1, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  generate_tangents(mesh, 0);
  ASSERT_EQ(mesh.positions.size(), 5u) << "same orientation: nothing is split";
  EXPECT_NEAR(mesh.tangents[0].x, 2 / std::sqrt(5.0f), 1e-6f);
  EXPECT_NEAR(mesh.tangents[0].y, 1 / std::sqrt(5.0f), 1e-6f);
  EXPECT_EQ(mesh.tangents[0].w, 1);
}

// Separate copies of a vertex that agree in position, normal and uv are one; those at a uv seam are not.
TEST(Tangents, WeldEqualVerticesAndKeepSeams) {
  Mesh mesh;  // the previous test's triangles without shared indices
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.normals.assign(6, Vec3(0, 0, 1));
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, -1}, {0, 0}, {0, -1}, {-1, -1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  Mesh seam = mesh;
  generate_tangents(mesh, 0);
  EXPECT_EQ(mesh.tangents[0], mesh.tangents[3]);
  EXPECT_NEAR(mesh.tangents[0].x, 2 / std::sqrt(5.0f), 1e-6f);

  for (int v = 3; v < 6; ++v) seam.uvs[0][v] += Vec2(4, 0);
  generate_tangents(seam, 0);
  EXPECT_NEAR(seam.tangents[0].x, 1, 1e-6f);
  EXPECT_NEAR(seam.tangents[3].y, 1, 1e-6f);
}

// Cylinder of radius 1 about Y with smooth normals: at angle a the tangent is the direction of growing a,
// (-sin a, 0, cos a), up to the chords' symmetric error, which cancels at inner vertices.
TEST(Tangents, CurvedSurfacesAreSmooth) {
  constexpr int segments = 24;
  Mesh mesh;
  for (int i = 0; i <= segments; ++i) {
    const float a = 2 * pi * float(i) / segments;
    for (const float y : {0.0f, 0.2f}) {
      mesh.positions.push_back({std::cos(a), y, std::sin(a)});
      mesh.normals.push_back({std::cos(a), 0, std::sin(a)});
      mesh.uvs[0].push_back({float(i) / segments, y});
    }
  }
  for (std::uint32_t i = 0; i < segments; ++i) {
    mesh.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
    mesh.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
  }
  generate_tangents(mesh, 0);
  for (std::size_t v = 2; v + 2 < mesh.positions.size(); ++v) {
    const Vec3 p = mesh.positions[v], tangent(mesh.tangents[v]);
    EXPECT_NEAR(glm::length(tangent - Vec3(-p.z, 0, p.x)), 0, 1e-5f);
    EXPECT_NEAR(glm::dot(tangent, mesh.normals[v]), 0, 1e-6f);
  }
}

TEST(Tangents, DegenerateTrianglesTakeThoseOfTheirNeighbours) {
  Mesh mesh = make_square({1, 0, 0}, {0, -1, 1});
  mesh.triangles.push_back({0, 1, 1});
  mesh.triangles.push_back({2, 2, 2});
  generate_tangents(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 4u);
  expect_tangents(mesh, {1, 0, 0, 1});
}

TEST(Tangents, UvsWithoutAreaGiveSomeUnitPerpendicular) {
  Mesh mesh = make_square({0, 0, 0.5f}, {0, 0, 0.5f});
  mesh.positions.push_back({9, 9, 9});  // used by no triangle
  mesh.normals.push_back({1, 0, 0});
  mesh.uvs[0].push_back({0, 0});
  generate_tangents(mesh, 0);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(glm::length(Vec3(mesh.tangents[v])), 1, 1e-6f);
    EXPECT_NEAR(mesh.tangents[v].z, 0, 1e-6f);
  }
  EXPECT_EQ(std::abs(mesh.tangents[4].w), 1);
}

// Without normals the flat ones count: both faces of a roof have u along +X, tangents in their planes, no shared
// vertices.
TEST(Tangents, FlatMeshesUseTheNormalsOfTheirTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, 1, 1}};
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0.5f, -1}, {0.5f, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  generate_tangents(mesh, 0);
  EXPECT_TRUE(mesh.normals.empty());
  ASSERT_EQ(mesh.positions.size(), 6u);
  for (const Triangle t : mesh.triangles) {
    const Vec3 normal =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(glm::dot(Vec3(mesh.tangents[t[c]]), normal), 0, 1e-6f);
  }
}

}  // namespace
}  // namespace candil
