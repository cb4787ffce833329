// The aperture: its shape, and the blur that it makes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/camera.h"
#include "core/warp.h"
#include "tests/support/chi_square.h"

namespace candil::test {
namespace {

// Cells of equal area: wedges between the centre and each edge, cut by similar polygons and along the edge.
TEST(Polygon, IsSampledUniformly) {
  constexpr int count = 200'000, rings = 10, parts = 4;
  for (const int corners : {3, 5, 6, 64}) {
    std::vector<double> observed(corners * rings * parts);
    const std::vector<double> expected(observed.size(),
                                       static_cast<double>(count) / static_cast<double>(observed.size()));
    const double half_step = std::numbers::pi / corners, apothem = std::cos(half_step);
    Random random(1);
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 p(sample_regular_polygon(random.next_2d(), corners));
      const double turn = std::atan2(p.y, p.x) + 2 * std::numbers::pi;
      const double wedge = std::floor(turn / (2 * half_step)), middle = (2 * wedge + 1) * half_step;
      const double height = p.x * std::cos(middle) + p.y * std::sin(middle);
      const double along = p.y * std::cos(middle) - p.x * std::sin(middle);
      ASSERT_LE(height, apothem + 1e-6) << "outside";
      const double ring = std::min(rings - 1.0, std::floor(std::pow(height / apothem, 2) * rings));
      const double share = 0.5 * (1 + along / (height * std::tan(half_step)));
      const double part = std::clamp(std::floor(share * parts), 0.0, parts - 1.0);
      ++observed[static_cast<std::size_t>((std::fmod(wedge, corners) * rings + ring) * parts + part)];
    }
    EXPECT_GT(chi_square_test(observed, expected).p_value, significance) << corners << " corners";
  }
}

// Neighbours stay neighbours: a jump would show as a step of the order of 1.
TEST(Polygon, IsContinuous) {
  constexpr int n = 400;
  for (const int corners : {3, 5, 8}) {
    float largest = 0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const Vec2 u = Vec2(x, y) / static_cast<float>(n), step(1.0f / n, 0);
        const Vec2 here = sample_regular_polygon(u, corners);
        largest = glm::max(largest, glm::length(sample_regular_polygon(u + step, corners) - here));
        largest = glm::max(largest, glm::length(sample_regular_polygon(u + Vec2(0, step.x), corners) - here));
      }
    }
    EXPECT_LT(largest, 8.0f / n) << corners << " corners";
  }
}

struct Aperture {
  int blades;
  float rotation;
  float width;  // along the first corner's direction, for radius 1
};

// The circle of confusion. All rays of a pixel meet in one point P of the plane in focus, at depth f. Those of a lens
// of width A form, by similar triangles, a bundle of width A |d - f| / f at depth d, and pixels that are s apart at
// depth f have bundles s d / f apart there. A point at depth d is seen by all pixels whose bundle holds it, that is by
//   (A |d - f| / f) / (s d / f) = A |d - f| / d / s
// pixels: its image has the width c = A |d - f| / d measured at the plane in focus, and c v / f on a sensor at the
// image distance v, where pixels are s v / f wide. A is 2 R for a round aperture and for an even number n of blades
// from corner to corner, and R (1 + cos(pi / n)) from a corner to the edge opposite for an odd one.
TEST(Lens, CircleOfConfusionIsThatOfAThinLens) {
  const Aperture apertures[] = {
      {0, 0, 2}, {6, 0, 2}, {6, 0.4f, 2}, {5, 0, 1 + std::cos(pi / 5)}, {5, -1.1f, 1 + std::cos(pi / 5)}};
  for (const Aperture& aperture : apertures) {
    Camera camera;  // at the origin, along -Z
    camera.yfov = 0.7f;
    camera.lens_radius = 0.05f;
    camera.lens_blades = aperture.blades;
    camera.lens_rotation = aperture.rotation;
    camera.focus_distance = 4;
    constexpr int height = 200;
    const CameraRays rays(camera, height, height);
    const float focus = camera.focus_distance, pixel_size = focus * 2 * std::tan(0.35f) / height;
    const Vec2 axis(std::cos(aperture.rotation), std::sin(aperture.rotation));
    for (const float depth : {1.0f, 2.5f, 4.0f, 9.0f, 200.0f}) {
      const auto at_depth = [&](Vec2 pixel, Vec2 u) {
        const Ray ray = rays.ray(pixel, u);
        return Vec2(ray.origin + ray.direction * ((-depth - ray.origin.z) / ray.direction.z));
      };
      const Vec2 pixel(100, 100);
      float low = infinity, high = -infinity;
      // The rim of the square goes to the rim of the aperture, its corners and edges included.
      constexpr int n = 4000;
      for (int i = 0; i < 4 * n; ++i) {
        const float side = static_cast<float>(i % n) / n;
        const Vec2 u = i < n       ? Vec2(side, 0)
                       : i < 2 * n ? Vec2(side, one_minus_epsilon)
                       : i < 3 * n ? Vec2(0, side)
                                   : Vec2(one_minus_epsilon, side);
        const float place = glm::dot(at_depth(pixel, u), axis);
        low = glm::min(low, place), high = glm::max(high, place);
      }
      // The middle of the lens, where the map of the square has the centre.
      const float shift = (at_depth(pixel + Vec2(50, 0), Vec2(0.5f)) - at_depth(pixel, Vec2(0.5f))).x / 50;
      const float pixels = (high - low) / shift;
      const float expected = aperture.width * camera.lens_radius * std::abs(depth - focus) / depth / pixel_size;
      EXPECT_NEAR(pixels, expected, 2e-3f * expected + 2e-3f) << aperture.blades << " blades, depth " << depth;
    }
  }
}

// Turned as the camera sees it: the first corner of a triangle at a right angle to +X is up.
TEST(Lens, FirstCornerIsWhereTheRotationSays) {
  Camera camera;
  camera.lens_radius = 1;
  camera.lens_blades = 3;
  camera.lens_rotation = pi / 2;
  const CameraRays rays(camera, 10, 10);
  Vec3 low(infinity), high(-infinity);
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 origin = rays.ray({5, 5}, random.next_2d()).origin;
    low = glm::min(low, origin), high = glm::max(high, origin);
  }
  EXPECT_NEAR(high.y, 1, 0.02f);
  EXPECT_NEAR(low.y, -0.5f, 0.02f);
  EXPECT_NEAR(high.x, std::sqrt(0.75f), 0.02f);
  EXPECT_NEAR(low.x, -std::sqrt(0.75f), 0.02f);
}

}  // namespace
}  // namespace candil::test
