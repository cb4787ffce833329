// The environment: where its image is in the world, and directions that follow its light.
#include "core/environment.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/color.h"
#include "core/warp.h"
#include "tests/support/chi_square.h"
#include "tests/support/light_scenes.h"

namespace candil::test {
namespace {

Environment image_environment(Image image, float rotation) {
  Environment environment;
  environment.tint = Vec3(1);
  environment.image = std::move(image);
  environment.rotation = rotation;
  return environment;
}

TEST(EnvironmentLight, SamplesFollowTheDensity) {
  for (const float rotation : {0.0f, 1.1f, -4.0f}) {
    const Environment environment = image_environment(uneven_image(), rotation);
    const EnvironmentLight light(environment);
    // The chi-square grid's axis is +z, the image's +y: the borders of cells and texels have nothing to do with each
    // other.
    const auto sample = [&](Random& random) { return std::optional(light.sample(random.next_2d()).direction); };
    const auto pdf = [&](Vec3 direction) { return light.pdf(direction); };
    const ChiSquareResult result = test_directions(sample, pdf, 200000, 1, {12, 24});
    EXPECT_GT(result.p_value, significance) << rotation;
  }
}

// Next to the poles too, where the density of an image's row grows without bound.
TEST(EnvironmentLight, SamplesReportTheirDensityNearThePoles) {
  Image image(1, 2, 3);
  for (float& value : image.pixels) value = 1;
  const Environment environment = image_environment(image, 0.4f);
  const EnvironmentLight light(environment);
  for (const float v : {1e-3f, 1e-2f, 0.1f, 0.9f, 0.99f, 0.999f}) {
    for (const float u : {0.1f, 0.4f, 0.8f}) {
      const EnvironmentLight::Sample sample = light.sample({u, v});
      EXPECT_NEAR(light.pdf(sample.direction), sample.pdf, 1e-4f * sample.pdf) << u << ' ' << v;
    }
  }
}

TEST(EnvironmentLight, ConstantIsUniform) {
  Environment environment;
  environment.tint = Vec3(1, 2, 3);
  const EnvironmentLight light(environment);
  EXPECT_EQ(light.radiance(Vec3(0, -1, 0)), environment.tint);
  EXPECT_FLOAT_EQ(light.pdf(Vec3(1, 0, 0)), 1 / (4 * pi));
  const auto sample = [&](Random& random) { return std::optional(light.sample(random.next_2d()).direction); };
  EXPECT_GT(test_directions(
                sample, [&](Vec3 d) { return light.pdf(d); }, 50000)
                .p_value,
            significance);
}

// A picture whose red grows to the right, whose green grows downwards: values at texel centres are exact.
Image orientation_image() {
  Image image(4, 2, 3);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      image.pixel(x, y)[0] = static_cast<float>(x);
      image.pixel(x, y)[1] = static_cast<float>(y);
    }
  }
  return image;
}

/// Longitude to the right of the image's centre, and latitude, both in degrees.
Vec3 direction_of(float longitude, float latitude) {
  const float phi = glm::radians(longitude), height = glm::radians(latitude);
  return {std::cos(height) * std::sin(phi), std::sin(height), -std::cos(height) * std::cos(phi)};
}

// Centre along -Z, right half towards +X, top at +Y: texel centres lie at longitudes -135, -45, 45, 135 and at
// latitudes 45 and -45.
TEST(EnvironmentLight, ImageHasItsPlaceInTheWorld) {
  const Environment environment = image_environment(orientation_image(), 0);
  const EnvironmentLight light(environment);
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 2; ++y) {
      const Vec3 radiance = light.radiance(direction_of(-135 + 90 * static_cast<float>(x), y == 0 ? 45.0f : -45.0f));
      EXPECT_NEAR(radiance.x, x, 1e-5f);
      EXPECT_NEAR(radiance.y, y, 1e-5f);
    }
  }
  EXPECT_NEAR(light.radiance(Vec3(0, 0, -1)).x, 1.5f, 1e-5f);  // between the middle columns
  EXPECT_NEAR(light.radiance(Vec3(0, 0, 1)).x, 1.5f, 1e-5f);   // between the last and the first, which are neighbours
  EXPECT_NEAR(light.radiance(Vec3(1, 0, 0)).x, 2.5f, 1e-5f);
  EXPECT_NEAR(light.radiance(Vec3(0, 1, 0)).y, 0, 1e-5f);
  EXPECT_NEAR(light.radiance(Vec3(0, -1, 0)).y, 1, 1e-5f);
}

// Counter-clockwise seen from above by 90 degrees: what was along -Z (away) is along -X (left).
TEST(EnvironmentLight, RotationIsCounterClockwiseFromAbove) {
  const Environment before = image_environment(uneven_image(), 0), after = image_environment(uneven_image(), pi / 2);
  const EnvironmentLight plain(before), rotated(after);
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 d = sample_sphere(random.next_2d());
    const Vec3 turned(d.z, d.y, -d.x);  // -Z to -X, +X to -Z
    const float expected = plain.radiance(d).x;
    EXPECT_NEAR(rotated.radiance(turned).x, expected, 1e-3f + 1e-4f * expected);
  }
}

// mean_luminance() is the mean over the sphere, up to how the grid of weights treats sin(theta) within a row.
TEST(EnvironmentLight, MeanLuminanceIsTheMeanOverTheSphere) {
  const Environment environment = image_environment(uneven_image(), 0.3f);
  const EnvironmentLight light(environment);
  double sum = 0;
  constexpr int side = 600;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 u = (Vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
    sum += luminance(light.radiance(sample_sphere(u))) / (side * side);
  }
  EXPECT_NEAR(light.mean_luminance(), sum, 0.1 * sum);  // rows of 45 degrees
}

// Wherever there is light, there is density: an estimator without it would lose that light.
TEST(EnvironmentLight, DensityIsPositiveWhereverThereIsLight) {
  Image image(8, 4, 3);
  for (int c = 0; c < 3; ++c) image.pixel(7, 1)[c] = 1;  // at the seam
  const Environment environment = image_environment(image, 0);
  const EnvironmentLight light(environment);
  Random random(7);
  int lit = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d = sample_sphere(random.next_2d());
    if (light.radiance(d).x <= 0) continue;
    ++lit;
    EXPECT_GT(light.pdf(d), 0) << d.x << ' ' << d.y << ' ' << d.z;
  }
  EXPECT_GT(lit, 1000);
}

}  // namespace
}  // namespace candil::test
