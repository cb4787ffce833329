#include "core/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_near.h"

namespace candil {
namespace {

using test::expect_near;

/// At (1, 2, 3), looking along -X: right is -Z, up is +Y.
Camera sideways() {
  Camera camera;
  camera.to_world = {Mat3(Vec3(0, 0, -1), Vec3(0, 1, 0), Vec3(1, 0, 0)), Vec3(1, 2, 3)};
  camera.yfov = 1.0f;
  return camera;
}

TEST(Camera, PerspectiveCorners) {
  const CameraRays rays(sideways(), 300, 200);
  const float y = std::tan(0.5f), x = 1.5f * y;
  expect_near(rays.ray({150, 100}, Vec2(0.5f)).direction, Vec3(-1, 0, 0));
  expect_near(rays.ray({0, 0}, Vec2(0.5f)).direction, glm::normalize(Vec3(-1, y, x)));
  expect_near(rays.ray({300, 0}, Vec2(0.5f)).direction, glm::normalize(Vec3(-1, y, -x)));
  expect_near(rays.ray({0, 200}, Vec2(0.5f)).direction, glm::normalize(Vec3(-1, -y, x)));
  expect_near(rays.ray({77, 12}, Vec2(0.9f)).origin, Vec3(1, 2, 3));
  EXPECT_FALSE(rays.has_lens());
}

TEST(Camera, ImageNarrowerThanFramedKeepsTheWidth) {
  Camera camera = sideways();
  camera.aspect = 2;
  const float y = std::tan(0.5f);
  // Framed 2:1, rendered 1:1: the half width stays 2y, and the half height grows to it.
  expect_near(CameraRays(camera, 100, 100).ray({100, 0}, Vec2(0)).direction, glm::normalize(Vec3(-1, 2 * y, -2 * y)));
  // Wider than framed: the height stays.
  expect_near(CameraRays(camera, 300, 100).ray({300, 0}, Vec2(0)).direction, glm::normalize(Vec3(-1, y, -3 * y)));
}

TEST(Camera, ScaleAndMirrorOfTheNodeAreIgnored) {
  Camera scaled = sideways();
  scaled.to_world.linear = scaled.to_world.linear * Mat3(Vec3(-3, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 0.5f));
  const CameraRays plain(sideways(), 64, 48), other(scaled, 64, 48);
  for (const Vec2 pixel : {Vec2(0, 0), Vec2(64, 0), Vec2(10, 40)}) {
    expect_near(plain.ray(pixel, Vec2(0)).direction, other.ray(pixel, Vec2(0)).direction);
  }
}

TEST(Camera, OrthographicRaysAreParallel) {
  Camera camera = sideways();
  camera.kind = CameraKind::orthographic;
  camera.xmag = 3, camera.ymag = 2;
  const CameraRays rays(camera, 300, 200);
  for (const Vec2 pixel : {Vec2(0, 0), Vec2(300, 200), Vec2(10, 150)})
    expect_near(rays.ray(pixel, Vec2(0)).direction, Vec3(-1, 0, 0));
  expect_near(rays.ray({0, 0}, Vec2(0)).origin, Vec3(1, 2 + 2, 3 + 3));
  expect_near(rays.ray({300, 200}, Vec2(0)).origin, Vec3(1, 2 - 2, 3 - 3));
}

TEST(Camera, LensFocusesOnItsPlaneAndBlursByTheThinLensEquation) {
  for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
    Camera camera = sideways();
    camera.kind = kind;
    camera.lens_radius = 0.1f;
    camera.focus_distance = 4;
    const CameraRays rays(camera, 100, 100);
    ASSERT_TRUE(rays.has_lens());
    const Vec2 pixel(23, 61);
    const auto at_depth = [](const Ray& ray, float depth) {  // the viewing axis is -X, the lens at x = 1
      return ray.origin + ray.direction * ((1 - depth - ray.origin.x) / ray.direction.x);
    };
    const Ray center = rays.ray(pixel, Vec2(0.5f));
    float widest = 0;
    for (int i = 0; i < 32 * 32; ++i) {
      const Ray ray = rays.ray(pixel, Vec2(i % 32, i / 32) / 31.0f * one_minus_epsilon);
      EXPECT_NEAR(glm::length(ray.direction), 1, 1e-5f);
      EXPECT_LE(glm::length(ray.origin - center.origin), 0.1f + 1e-6f);
      expect_near(at_depth(ray, 4), at_depth(center, 4), 1e-4f);
      widest = glm::max(widest, glm::length(at_depth(ray, 7) - at_depth(center, 7)));
    }
    // Similar triangles: at depth 7 the cone that met at 4 has the radius 0.1 * (7 - 4) / 4.
    EXPECT_NEAR(widest, 0.075f, 1e-3f);
  }
}

TEST(Camera, LookAtPutsTheTargetInTheMiddleAndInFocus) {
  for (const Vec3 from : {Vec3(3, 4, 5), Vec3(0, 7, 0), Vec3(0, -7, 1e-6f), Vec3(-2, 0, 0)}) {
    const Camera camera = look_at(from, Vec3(0, 1, 0), 0.7f);
    EXPECT_NEAR(camera.focus_distance, glm::length(from - Vec3(0, 1, 0)), 1e-5f);
    const Ray ray = CameraRays(camera, 10, 10).ray({5, 5}, Vec2(0.5f));
    expect_near(ray.origin + camera.focus_distance * ray.direction, Vec3(0, 1, 0));
    EXPECT_NEAR(glm::determinant(camera.to_world.linear), 1, 1e-5f);
  }
}

TEST(Camera, LookAtItselfIsStillACamera) {
  const Camera camera = look_at(Vec3(1), Vec3(1), 0.7f);
  EXPECT_TRUE(is_finite(CameraRays(camera, 4, 4).ray({1, 1}, Vec2(0)).direction));
}

/// Position of a point in the image, [-1, 1] in both directions; nothing behind the camera.
std::optional<Vec2> project(const Camera& camera, Vec3 p, float aspect) {
  const Vec3 local = glm::transpose(camera.to_world.linear) * (p - camera.to_world.translation);
  if (local.z >= 0) return std::nullopt;
  const float tan_y = std::tan(0.5f * camera.yfov);
  return Vec2(local.x / (-local.z * tan_y * aspect), local.y / (-local.z * tan_y));
}

std::vector<Vec3> corners_of(const Bounds& box) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(box.corner(i));
  return corners;
}

TEST(Camera, FramedPointsFillThePicture) {
  const Bounds boxes[] = {
      {Vec3(-1, 0, -2), Vec3(3, 1, 2)}, {Vec3(1e-3f), Vec3(2e-3f)}, {Vec3(-500, 0, 0), Vec3(500, 1, 1)}};
  for (const Bounds& box : boxes) {
    for (const float azimuth : {0.0f, 0.6f, 2.0f, -3.0f}) {
      for (const float elevation : {0.0f, 0.4f, pi / 2, -1.2f}) {
        for (const float aspect : {0.5f, 1.0f, 1.78f}) {
          const Camera camera = frame_points(corners_of(box), azimuth, elevation, aspect);
          float furthest = 0;
          for (int corner = 0; corner < 8; ++corner) {
            const auto place = project(camera, box.corner(corner), aspect);
            ASSERT_TRUE(place);
            furthest = glm::max(furthest, glm::max(std::abs(place->x), std::abs(place->y)));
          }
          EXPECT_LE(furthest, 1.0f);
          EXPECT_GE(furthest, 0.9f) << "the frame should be filled";
        }
      }
    }
  }
}

TEST(Camera, FramingLooksFromTheGivenSide) {
  const std::vector<Vec3> box = corners_of({Vec3(-1), Vec3(1)});
  // Azimuth 0 is +Z, a quarter turn +X; elevation lifts the eye.
  expect_near(frame_points(box, 0, 0, 1, 10.0f).to_world.translation, Vec3(0, 0, 10), 1e-4f);
  expect_near(frame_points(box, pi / 2, 0, 1, 10.0f).to_world.translation, Vec3(10, 0, 0), 1e-4f);
  expect_near(frame_points(box, 0, pi / 6, 1, 10.0f).to_world.translation, Vec3(0, 5, 10 * std::cos(pi / 6)), 1e-4f);
}

TEST(Camera, FramingNothingOrAPointGivesACamera) {
  const Camera empty = frame_points({}, 0.5f, 0.3f, 1);
  EXPECT_TRUE(is_finite(empty.to_world.translation));
  const Camera point = frame_points(std::vector{Vec3(2)}, 0.5f, 0.3f, 1);
  EXPECT_GT(glm::length(point.to_world.translation - Vec3(2)), 0);
  EXPECT_TRUE(is_finite(point.to_world.translation));
}

}  // namespace
}  // namespace candil
