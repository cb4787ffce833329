#include "core/surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/expect_near.h"

namespace candil {
namespace {

using test::expect_near;

/// One triangle, one instance. Normals bend away from the flat one; tangents are not orthogonal to anything in
/// particular.
Scene triangle_scene(const Affine& to_world, bool is_smooth = true) {
  Mesh mesh;
  mesh.positions = {{0.2f, -0.1f, 0.3f}, {1.4f, 0.2f, 0.1f}, {0.3f, 1.1f, -0.4f}};
  mesh.triangles = {{0, 1, 2}};
  const Vec3 flat =
      glm::normalize(glm::cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]));
  if (is_smooth) {
    for (const Vec3 bend : {Vec3(0.3f, 0, 0), Vec3(0, 0.2f, 0.1f), Vec3(-0.1f, 0, -0.2f)}) {
      mesh.normals.push_back(glm::normalize(flat + bend));
    }
    for (const Vec3 n : mesh.normals)
      mesh.tangents.emplace_back(glm::normalize(glm::cross(n, Vec3(0.3f, 1, 0.2f))), -1);
  }
  mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
  mesh.uvs[1] = {{5, 5}, {6, 5}, {5, 7}};
  mesh.colors = {Vec4(1, 0, 0, 1), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0.5f)};
  Scene scene;
  scene.meshes = {mesh};
  scene.objects = {{"", 0, 1}};
  scene.instances = {{"", 0, to_world, false}};
  scene.materials.resize(1);
  scene.materials[0].base_color_texture.texture = 0;  // texture coordinates are only looked up for textures
  return scene;
}

Hit hit_at(float b, float c) {
  Hit hit;
  hit.barycentric = {b, c};
  return hit;
}

const std::array transforms = {
    Affine{},
    Affine{Mat3(1), Vec3(10, -20, 30)},
    Affine{Mat3(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)), Vec3(1, 2, 3)},                   // mirrored
    Affine{Mat3(Vec3(3, 0, 0), Vec3(0, 0.2f, 0), Vec3(0, 0, 1)), Vec3(0)},                       // stretched
    Affine{Mat3(Vec3(0.5f, 0.2f, 0), Vec3(-0.4f, 2, 0.3f), Vec3(0, 0.6f, -1)), Vec3(-1, 0, 4)},  // all of it, mirrored
    Affine{Mat3(1e-3f), Vec3(0)},
    Affine{Mat3(-1e4f), Vec3(5)},
};

/// The flat normal of the front side of a transformed triangle, from its winding in world space; a mirrored transform
/// turns the winding round (glTF 2.0, section 3.7.4).
Vec3 front_normal(const Scene& scene) {
  const Affine& m = scene.instances[0].to_world;
  const Mesh& mesh = scene.meshes[0];
  const Vec3 a = m.point(mesh.positions[0]), b = m.point(mesh.positions[1]), c = m.point(mesh.positions[2]);
  const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
  return glm::determinant(m.linear) < 0 ? -Vec3(normal) : Vec3(normal);
}

TEST(SurfacePoint, InterpolatesWhatTheMeshHas) {
  const SurfacePoint point = make_surface_point(triangle_scene(Affine{}), hit_at(0.25f, 0.5f));
  expect_near(point.position, Vec3(0.55f, 0.575f, -0.1f), 1e-6f, "position");
  EXPECT_FLOAT_EQ(point.uv[0].x, 0.25f);
  EXPECT_FLOAT_EQ(point.uv[0].y, 0.5f);
  EXPECT_FLOAT_EQ(point.uv[1].x, 5.25f);
  EXPECT_FLOAT_EQ(point.uv[1].y, 6);
  EXPECT_FLOAT_EQ(point.color.x, 0.25f);
  EXPECT_FLOAT_EQ(point.color.z, 0.5f);
  EXPECT_FLOAT_EQ(point.color.w, 0.5f);
}

TEST(SurfacePoint, DefaultsForWhatItLacks) {
  Scene scene = triangle_scene(Affine{}, false);
  scene.meshes[0].uvs = {};
  scene.meshes[0].colors.clear();
  const SurfacePoint point = make_surface_point(scene, hit_at(0.25f, 0.5f));
  EXPECT_EQ(point.normal, point.normal_geometric);
  EXPECT_EQ(point.color, Vec4(1));
  EXPECT_EQ(point.tangent, Vec4(0));
  EXPECT_EQ(point.uv[0], Vec2(0));
}

TEST(SurfacePoint, FlatNormalIsOnTheFrontUnderAnyTransform) {
  for (const Affine& transform : transforms) {
    const Scene scene = triangle_scene(transform, false);
    const SurfacePoint point = make_surface_point(scene, hit_at(0.3f, 0.3f));
    expect_near(point.normal_geometric, front_normal(scene), 1e-4f, "normal");
    EXPECT_NEAR(glm::length(point.normal_geometric), 1, 1e-5f);
  }
}

// Normals go with M^-T, front side kept; tangents with M; the handedness changes where the transform mirrors, so that
// the bitangent too stays what M makes of it: on the surface's side that it was on.
TEST(SurfacePoint, ShadingFrameFollowsTheTransform) {
  const Scene local = triangle_scene(Affine{});
  const SurfacePoint before = make_surface_point(local, hit_at(0.2f, 0.5f));
  for (const Affine& transform : transforms) {
    const Scene scene = triangle_scene(transform);
    const SurfacePoint point = make_surface_point(scene, hit_at(0.2f, 0.5f));
    expect_near(point.position, transform.point(before.position), 1e-5f * (1 + glm::length(point.position)),
                "position");
    const Vec3 normal = glm::normalize(glm::transpose(glm::inverse(transform.linear)) * before.normal);
    expect_near(point.normal, normal, 1e-4f, "normal");
    EXPECT_GT(glm::dot(point.normal, point.normal_geometric), 0);
    expect_near(glm::normalize(Vec3(point.tangent)), glm::normalize(transform.vector(Vec3(before.tangent))), 1e-4f,
                "tangent");
    const Vec3 bitangent = point.tangent.w * glm::cross(point.normal, Vec3(point.tangent));
    const Vec3 bitangent_before = before.tangent.w * glm::cross(before.normal, Vec3(before.tangent));
    EXPECT_GT(glm::dot(bitangent, transform.vector(bitangent_before)), 0);
  }
}

// A normal map mixes tangent and normal: scaled by an instance, the tangent would make the map stronger or weaker.
TEST(SurfacePoint, TangentIsUnit) {
  for (const Affine& transform : transforms) {
    const SurfacePoint point = make_surface_point(triangle_scene(transform), hit_at(0.2f, 0.5f));
    EXPECT_NEAR(glm::length(Vec3(point.tangent)), 1, 1e-3f);
    EXPECT_NEAR(std::abs(point.tangent.w), 1, 1e-6f);
  }
}

// A normal attribute that points to the back is turned round: the winding decides.
TEST(SurfacePoint, NormalsThatDisagreeWithTheWindingAreTurned) {
  Scene scene = triangle_scene(Affine{});
  for (Vec3& n : scene.meshes[0].normals) n = -n;
  const SurfacePoint point = make_surface_point(scene, hit_at(0.2f, 0.5f));
  EXPECT_GT(glm::dot(point.normal, point.normal_geometric), 0.5f);
}

TEST(SurfacePoint, UnusableNormalsFallBackToTheFlatOne) {
  Scene scene = triangle_scene(Affine{});
  scene.meshes[0].normals = {Vec3(0), Vec3(0), Vec3(0)};
  const SurfacePoint zero = make_surface_point(scene, hit_at(0.2f, 0.5f));
  EXPECT_EQ(zero.normal, zero.normal_geometric);
  scene.meshes[0].positions[2] = scene.meshes[0].positions[1];  // no area either
  const SurfacePoint nothing = make_surface_point(scene, hit_at(0.2f, 0.5f));
  EXPECT_NEAR(glm::length(nothing.normal), 1, 1e-5f);
  EXPECT_NEAR(glm::length(nothing.normal_geometric), 1, 1e-5f);
}

// The step must outweigh the rounding of the position: the stepped point is on its side of the exact plane.
TEST(SurfacePoint, OffsetReachesTheRightSide) {
  for (const Affine& transform : transforms) {
    const Scene scene = triangle_scene(transform);
    const Mesh& mesh = scene.meshes[0];
    const glm::dmat3 linear(transform.linear);
    const auto exact = [&](int i) {
      return linear * glm::dvec3(mesh.positions[i]) + glm::dvec3(transform.translation);
    };
    const glm::dvec3 a = exact(0), b = exact(1), c = exact(2);
    for (int i = 0; i < 400; ++i) {
      const float u = (static_cast<float>(i % 20) + 0.5f) / 20, v = (static_cast<float>(i / 20) + 0.5f) / 20;
      if (u + v > 1) continue;
      const SurfacePoint point = make_surface_point(scene, hit_at(u, v));
      glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
      if (glm::dot(normal, glm::dvec3(point.normal_geometric)) < 0) normal = -normal;
      const Vec3 up = point.normal_geometric;
      const double above = glm::dot(glm::dvec3(offset_origin(point, up)) - a, normal);
      const double below = glm::dot(glm::dvec3(offset_origin(point, -up)) - a, normal);
      // At least half of the step is left after rounding.
      EXPECT_GT(above, 0.5 * point.offset);
      EXPECT_LT(below, -0.5 * point.offset);
    }
  }
}

}  // namespace
}  // namespace candil
