// Points on meshes with normals move to the smooth surface that the normals stand for.
#include <gtest/gtest.h>

#include <cmath>

#include "core/surface.h"

namespace candil::test {
namespace {

/// A triangle whose corners and normals are those of the unit sphere, `angle` radians from +z.
Scene spherical_triangle(float angle, bool is_concave = false) {
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  for (int i = 0; i < 3; ++i) {
    const float phi = 2 * pi * static_cast<float>(i) / 3;
    const Vec3 p(std::sin(angle) * std::cos(phi), std::sin(angle) * std::sin(phi), std::cos(angle));
    mesh.positions.push_back(p);
    mesh.normals.push_back(is_concave ? Vec3(-p.x, -p.y, p.z) : p);
  }
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  scene.objects = {{"", 0, 1}};
  scene.instances = {{"", 0, Affine{}, true}};
  return scene;
}

SurfacePoint point_at(const Scene& scene, Vec2 barycentric, Vec3 wo) {
  Hit hit;
  hit.barycentric = barycentric;
  SurfacePoint point = make_surface_point(scene, hit);
  face_viewer(point, wo);
  return point;
}

// The middle of a triangle whose corners are 15 degrees away lies 1 - cos 15 = 0.034 below the sphere. What is left are
// terms of fourth order, 0.26^4 / 8 = 0.0006 and the like: 1/20 of that.
TEST(SmoothSurface, PointsOfASphereLieOnIt) {
  const float angle = glm::radians(15.0f), sagitta = 1 - std::cos(angle);
  const Scene scene = spherical_triangle(angle);
  for (float b = 0; b <= 1; b += 0.125f) {
    for (float c = 0; b + c <= 1; c += 0.125f) {
      const SurfacePoint point = point_at(scene, Vec2(b, c), Vec3(0, 0, 1));
      EXPECT_TRUE(point.is_smooth);
      EXPECT_NEAR(glm::length(point.position), 1, 0.05f * sagitta) << b << " " << c;
      EXPECT_EQ(point.normal_of_sides(), point.normal);
    }
  }
  EXPECT_NEAR(glm::length(point_at(scene, Vec2(0), Vec3(0, 0, 1)).position), 1, 1e-6f) << "corners stay";
}

TEST(SmoothSurface, HollowsAndInsidesStayFlat) {
  const float angle = glm::radians(15.0f);
  const Scene hill = spherical_triangle(angle), hollow = spherical_triangle(angle, true);
  const Vec2 middle(1 / 3.0f);
  EXPECT_GT(point_at(hill, middle, Vec3(0, 0, 1)).position.z, 0.995f);
  EXPECT_NEAR(point_at(hill, middle, Vec3(0, 0, -1)).position.z, std::cos(angle), 1e-6f);
  EXPECT_NEAR(point_at(hollow, middle, Vec3(0, 0, 1)).position.z, std::cos(angle), 1e-6f);
  // Seen from behind, a hollow is a hill.
  EXPECT_LT(point_at(hollow, middle, Vec3(0, 0, -1)).position.z, 2 * std::cos(angle) - 0.995f);
}

TEST(SmoothSurface, InstancesScaleIt) {
  Scene scene = spherical_triangle(glm::radians(15.0f));
  const Vec2 barycentric(0.4f, 0.35f);
  const float bulge = point_at(scene, barycentric, Vec3(0, 0, 1)).bulge;
  ASSERT_GT(bulge, 0.01f);
  scene.instances[0].is_world_space = false;
  scene.instances[0].to_world.linear = Mat3(7.0f);
  EXPECT_NEAR(point_at(scene, barycentric, Vec3(0, 0, 1)).bulge, 7 * bulge, 1e-5f);
  scene.instances[0].to_world.linear = Mat3(2, 0, 0, 0, 2, 0, 0, 0, -2);  // mirrored: the front faces -z
  EXPECT_NEAR(point_at(scene, barycentric, Vec3(0, 0, -1)).bulge, 2 * bulge, 1e-5f);
}

// Glass has one boundary for both sides. The corners of a cube with smooth normals are 54.7 degrees off its faces: the
// surface "meant" would stand far out.
TEST(SmoothSurface, NotForGlassNorForCubesNorWithoutNormals) {
  Scene glass = spherical_triangle(glm::radians(15.0f));
  glass.materials[0].transmission = 1;
  Scene cube = spherical_triangle(glm::radians(54.7f));
  Scene flat = spherical_triangle(glm::radians(15.0f));
  flat.meshes[0].normals.clear();
  Scene turned = spherical_triangle(glm::radians(15.0f));
  for (Vec3& n : turned.meshes[0].normals) n = -n;
  for (const Scene* scene : {&glass, &cube, &flat, &turned}) {
    const SurfacePoint point = point_at(*scene, Vec2(1 / 3.0f), Vec3(0, 0, 1));
    EXPECT_FALSE(point.is_smooth);
    EXPECT_NEAR(point.position.z, scene->meshes[0].positions[0].z, 1e-6f);
    EXPECT_EQ(point.normal_of_sides(), point.normal_geometric);
  }
}

// At the outline of a sphere a triangle may still face the viewer where the normal does not.
TEST(SmoothSurface, NormalsFaceTheViewer) {
  const Scene scene = spherical_triangle(glm::radians(15.0f));
  const float theta = glm::radians(85.0f);
  const Vec3 wo(-std::sin(theta), 0,
                std::cos(theta));  // the normal near the first corner is 15 degrees off, towards +x
  const SurfacePoint point = point_at(scene, Vec2(0.01f), wo);
  EXPECT_GT(glm::dot(point.normal, wo), 0);
  EXPECT_NEAR(glm::length(point.normal), 1, 1e-6f);
}

// A ray that leaves along the smooth surface's side starts on that side, even if it points below the triangle's plane.
TEST(SmoothSurface, RaysStartOnTheSideOfTheNormal) {
  const Scene scene = spherical_triangle(glm::radians(15.0f));
  const SurfacePoint point = point_at(scene, Vec2(0.02f), Vec3(0, 0, 1));
  const float theta = glm::radians(95.0f);
  const Vec3 wi(std::sin(theta), 0, std::cos(theta));  // 5 degrees below the plane, 80 off the normal
  ASSERT_LT(glm::dot(wi, point.normal_geometric), 0);
  ASSERT_GT(glm::dot(wi, point.normal), 0);
  EXPECT_GT(offset_origin(point, wi).z, point.position.z);
}

}  // namespace
}  // namespace candil::test
