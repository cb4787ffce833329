// Each AOV against the mathematics of the very camera rays that the render shoots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/camera.h"
#include "core/pixel_filter.h"
#include "tests/support/aov_samples.h"

namespace candil::test {
namespace {

const Mat3 upwards(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0));  // +z turned to +y

/// What a ray meets first, in double precision.
struct Expected {
  double t = infinity;
  glm::dvec3 position, normal;
  glm::dvec2 uv;
  float material = -1, object = -1;
};

/// A plane y = -1 and a sphere of radius 1 around (0.3, 0, -1), behind a quad of its own far to the left.
class AovClosedForm : public testing::Test {
 protected:
  AovClosedForm() {
    SceneBuilder builder;
    const std::uint32_t quad = builder.add_diffuse(Vec3(1)), floor = builder.add_diffuse(Vec3(0.2f, 0.4f, 0.6f));
    const std::uint32_t ball = builder.add_diffuse(Vec3(0.7f, 0.5f, 0.3f));
    builder.add_quad(Vec3(-1000, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), quad);
    builder.add_shape(ShapeKind::plane, {upwards, Vec3(0, -1, 0)}, floor);
    builder.add_shape(ShapeKind::sphere, {Mat3(1), Vec3(0.3f, 0, -1)}, ball);
    stage_ = std::make_unique<Stage>(builder.scene);
    settings_.width = 40, settings_.height = 30;
    settings_.samples_per_pixel = 5;
    settings_.seed = 3;
    settings_.aovs.assign(all_aovs().begin(), all_aovs().end());
  }

  /// Plane: y of the ray reaches -1; the shape's x is the world's, its y is -z of the world, and (u, v) = (x, -y).
  /// Sphere: the smaller root of |o + t d - c|^2 = 1; u and v by the arc tangents and sines of core/shape.h.
  /// The quad is instance 0, so that the plane is object 1 and the sphere object 2; materials are alike.
  static Expected meet(const Ray& ray) {
    const glm::dvec3 o(ray.origin), d(ray.direction), center(Vec3(0.3f, 0, -1));
    Expected hit;
    if (d.y < 0 && o.y > -1) {
      hit.t = (-1 - o.y) / d.y;
      hit.normal = {0, 1, 0};
      hit.position = o + hit.t * d;
      hit.uv = {hit.position.x, hit.position.z};
      hit.material = hit.object = 1;
    }
    const double b = glm::dot(o - center, d), c = glm::dot(o - center, o - center) - 1;
    const double t = b * b - c < 0 ? infinity : -b - std::sqrt(b * b - c);
    if (t > 0 && t < hit.t) {
      const glm::dvec3 n = o + t * d - center;
      hit.t = t;
      hit.position = o + t * d;
      hit.normal = n;
      hit.uv = {0.5 + std::atan2(n.z, n.x) / (2 * M_PI), 0.5 - std::asin(n.y) / M_PI};
      hit.material = hit.object = 2;
    }
    return hit;
  }

  /// Compares the layer with the mean of `value` over the hits of each pixel, wherever the `tolerance` (relative above
  /// 1) of single precision is meant to hold: within 30 m.
  void expect_mean(Aov aov, const Camera& camera, double tolerance,
                   const std::function<glm::dvec3(const Expected&)>& value) const {
    const RenderResult result = render(stage_->context(), camera, settings_);
    const Image& image = layer(result, aov);
    const CameraRays rays(camera, settings_.width, settings_.height);
    const PixelFilter filter(settings_.filter);
    int compared = 0, partly = 0;
    for (int y = 0; y < settings_.height; ++y)
      for (int x = 0; x < settings_.width; ++x) {
        glm::dvec3 sum(0);
        std::uint32_t hits = 0;
        double furthest = 0;
        for (std::uint32_t i = 0; i < settings_.samples_per_pixel; ++i) {
          const Sampler sampler({x, y}, i, settings_.seed);
          const Vec2 offset = filter.sample(sampler.sample_2d(dimension::filter));
          const Vec2 lens = rays.has_lens() ? sampler.sample_2d(dimension::lens) : Vec2(0);
          const Expected hit = meet(rays.ray(Vec2(x, y) + 0.5f + offset, lens));
          if (std::isinf(hit.t)) continue;
          sum += value(hit);
          furthest = std::max(furthest, hit.t);
          ++hits;
        }
        partly += hits > 0 && hits < settings_.samples_per_pixel;
        if (furthest > 30) continue;
        ++compared;
        for (int c = 0; c < image.channels; ++c) {
          const double expected = hits > 0 ? sum[c] / hits : 0;
          ASSERT_NEAR(image.pixel(x, y)[c], expected, tolerance * std::max(1.0, std::abs(expected)))
              << aov_name(aov) << " at " << x << ", " << y << " channel " << c;
        }
      }
    EXPECT_GT(compared, settings_.width * settings_.height / 2);
    EXPECT_GT(partly, 10) << "no pixel shows that misses do not count";
  }

  std::unique_ptr<Stage> stage_;
  RenderSettings settings_;
  Camera camera_ = look_at(Vec3(0.2f, 0.4f, 4), Vec3(0.1f, 0, -1), 0.7f);
};

TEST_F(AovClosedForm, PositionIsInTheWorld) {
  expect_mean(Aov::position, camera_, 1e-5, [](const Expected& hit) { return hit.position; });
}

// Its distance grows with 1 / cos towards the corners, by 7 % here: a distance along the ray would not pass.
TEST_F(AovClosedForm, DepthIsAlongTheViewingAxis) {
  const glm::dvec3 from(Vec3(0.2f, 0.4f, 4)), at(Vec3(0.1f, 0, -1)), axis = glm::normalize(at - from);
  expect_mean(Aov::depth, camera_, 1e-5,
              [&](const Expected& hit) { return glm::dvec3(glm::dot(hit.position - from, axis), 0, 0); });
}

TEST_F(AovClosedForm, NormalsAreSigned) {
  expect_mean(Aov::normals, camera_, 1e-5, [](const Expected& hit) { return hit.normal; });
}

// Neither material has a texture. The arc sine is steep at the poles: a rounding of 1e-7 in y shows as 4e-4.
TEST_F(AovClosedForm, CoordinatesNeedNoTexture) {
  expect_mean(Aov::uv, camera_, 1e-4, [](const Expected& hit) { return glm::dvec3(hit.uv, 0); });
}

TEST_F(AovClosedForm, AlbedoIsTheClosures) {
  expect_mean(Aov::albedo, camera_, 1e-6, [](const Expected& hit) {
    return hit.material == 1 ? glm::dvec3(0.2f, 0.4f, 0.6f) : glm::dvec3(0.7f, 0.5f, 0.3f);
  });
}

// The lens blurs what is near and far: the samples of a pixel start all over it, as those of the picture do. At the
// outline of the sphere, roundings of the ray grow to their square roots.
TEST_F(AovClosedForm, ComesThroughTheLens) {
  camera_.lens_radius = 0.1f, camera_.focus_distance = 3;
  expect_mean(Aov::position, camera_, 1e-4, [](const Expected& hit) { return hit.position; });
}

TEST_F(AovClosedForm, OrthographicCamerasToo) {
  camera_.kind = CameraKind::orthographic;
  camera_.xmag = 3, camera_.ymag = 2.25f;
  expect_mean(Aov::position, camera_, 1e-5, [](const Expected& hit) { return hit.position; });
}

// Ids are those of the middle of the pixel without a lens, whatever the filter: never something between two.
TEST_F(AovClosedForm, IdsAreThoseOfThePixelsMiddle) {
  const CameraRays pinhole(camera_, settings_.width, settings_.height);
  camera_.lens_radius = 0.3f;
  const RenderResult result = render(stage_->context(), camera_, settings_);
  int counts[3] = {};
  for (int y = 0; y < settings_.height; ++y)
    for (int x = 0; x < settings_.width; ++x) {
      const Expected hit = meet(pinhole.ray(Vec2(x, y) + 0.5f, Vec2(0)));
      EXPECT_EQ(layer(result, Aov::material).pixel(x, y)[0], hit.material) << x << ", " << y;
      EXPECT_EQ(layer(result, Aov::object).pixel(x, y)[0], hit.object) << x << ", " << y;
      ++counts[hit.object < 0 ? 0 : static_cast<int>(hit.object)];
    }
  for (const int count : counts) EXPECT_GT(count, 30);
}

}  // namespace
}  // namespace candil::test
