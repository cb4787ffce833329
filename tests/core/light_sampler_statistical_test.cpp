// Lights: every density is the one that samples follow, and samples add up to the light that is there.
#include "core/light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/color.h"
#include "core/emission.h"
#include "core/frame.h"
#include "core/warp.h"
#include "tests/support/brute_force.h"
#include "tests/support/chi_square.h"
#include "tests/support/light_scenes.h"

namespace candil::test {
namespace {

class Lights : public testing::TestWithParam<LightScene> {
 protected:
  Lights() {
    GetParam().build(builder_);
    scene_ = builder_.scene;
    lights_.emplace(scene_);
    faces_.emplace(scene_, BruteForce::BackFaces::visible);
  }

  /// What a ray finds, and the density with which sample() would have: the sum over everything on its line, since light
  /// sampling looks through walls.
  struct Found {
    Vec3 radiance{0.0f};
    double pdf = 0;
  };
  Found look(Vec3 from, Vec3 direction) const {
    Found found;
    if (scene_.environment.is_present()) {
      found.radiance += lights_->environment().radiance(direction);
      found.pdf += lights_->pdf_miss(direction);
    }
    for (const Crossing& crossing : faces_->crossings({from, direction})) {
      const Found on_surface = look_at(from, direction, crossing);
      found.radiance += on_surface.radiance;
      found.pdf += on_surface.pdf;
    }
    return found;
  }

  /// The same for one surface alone; nothing for a back that does not shine.
  Found look_at(Vec3 from, Vec3 direction, const Crossing& crossing) const {
    Hit hit;
    hit.barycentric = crossing.barycentric;
    hit.instance = crossing.instance, hit.mesh = crossing.mesh, hit.triangle = crossing.triangle;
    const SurfacePoint on = make_surface_point(scene_, hit);
    const Material& material = scene_.materials[on.material];
    const bool is_front = glm::dot(direction, on.normal_geometric) < 0;
    if (!is_front && !material.is_double_sided) return {};
    return {emitted_radiance(scene_, on, is_front) * alpha_coverage(scene_, material, on.uv, on.color),
            lights_->pdf_hit(from, on)};
  }

  /// Within rounding of the border of two texels the density may be looked up on its other side.
  bool is_at_border_of_texels(Vec3 direction) const {
    const Frame frame(direction);
    const auto differs_across = [&](Vec3 step) {
      const float before = lights_->pdf_miss(glm::normalize(direction - 1e-5f * step));
      const float after = lights_->pdf_miss(glm::normalize(direction + 1e-5f * step));
      return std::abs(after - before) > 0.01f * glm::max(before, after);
    };
    return differs_across(frame.tangent) || differs_across(frame.bitangent);
  }

  SceneBuilder builder_;
  Scene scene_;
  std::optional<LightSampler> lights_;
  std::optional<BruteForce> faces_;
};

// Each sample is checked against the strategy that would have found its light by chance: density and radiance.
TEST_P(Lights, SamplesReportTheDensityOfTheirDirection) {
  Random random(1);
  int compared = 0;
  const SurfacePoint from = point_at(Vec3(0.1f, 0, 0.2f));
  for (int i = 0; i < 40000; ++i) {
    const float pick = random.next_1d();
    const std::optional<LightSample> sample = lights_->sample(from, pick, random.next_2d());
    if (!sample) continue;
    ASSERT_TRUE(is_finite(sample->wi) && is_finite(sample->radiance)) << i;
    ASSERT_TRUE(std::isfinite(sample->pdf) && sample->pdf > 0) << i;
    ASSERT_NEAR(glm::length(sample->wi), 1, 1e-5f);
    if (sample->is_delta) continue;
    // The one light that was picked is the one where the shadow ray ends.
    Found found;
    if (sample->shadow_ray.t_max == infinity) {
      if (is_at_border_of_texels(sample->wi)) continue;
      found = {lights_->environment().radiance(sample->wi), lights_->pdf_miss(sample->wi)};
    } else {
      for (const Crossing& crossing : faces_->crossings({from.position, sample->wi})) {
        if (std::abs(crossing.t - sample->shadow_ray.t_max) > 1e-4) continue;
        found = look_at(from.position, sample->wi, crossing);
      }
    }
    ++compared;
    ASSERT_NEAR(sample->pdf, found.pdf, 1e-3 * found.pdf) << i;
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(sample->radiance[c], found.radiance[c], 1e-3f * found.radiance[c] + 1e-4f) << i;
    }
  }
  if (std::string_view(GetParam().name) == "facing_away") {
    EXPECT_EQ(compared, 0);
  } else {
    EXPECT_GT(compared, 5000);
  }
}

// Irradiance on planes that face several ways: the mean of radiance cos / pdf over light samples against an
// integral over the hemisphere by directions that know nothing of lights.
TEST_P(Lights, SamplesAddUpToTheIrradiance) {
  for (const Vec3 normal : {Vec3(0, 1, 0), glm::normalize(Vec3(-1, 0.5f, -0.3f))}) {
    const SurfacePoint from = point_at(Vec3(0.1f, 0, 0.2f), normal);
    const Frame frame(normal);
    Random random(2);
    struct Mean {
      double sum = 0, squares = 0;
      int n = 0;
      void add(double x) { sum += x, squares += x * x, ++n; }
      double value() const { return sum / n; }
      double error() const { return std::sqrt(std::max(0.0, squares / n - value() * value()) / n); }
    } sampled, searched;
    for (int i = 0; i < 200000; ++i) {
      const float pick = random.next_1d();
      const std::optional<LightSample> sample = lights_->sample(from, pick, random.next_2d());
      const bool counts = sample && !sample->is_delta;
      sampled.add(counts ? luminance(sample->radiance) * glm::max(0.0f, glm::dot(sample->wi, normal)) / sample->pdf
                         : 0);
    }
    // Stratified over 700 x 700 cells of a cosine-weighted hemisphere: mean radiance times pi.
    constexpr int side = 700;
    for (int i = 0; i < side * side; ++i) {
      const Vec2 u = (Vec2(i % side, i / side) + random.next_2d()) / static_cast<float>(side);
      searched.add(pi * luminance(look(from.position, frame.to_world(sample_cosine_hemisphere(u))).radiance));
    }
    const double error = std::hypot(sampled.error(), searched.error());
    EXPECT_NEAR(sampled.value(), searched.value(), 6 * error + 1e-4 * searched.value());
    EXPECT_LE(error, 0.02 * searched.value()) << "too noisy to tell";
  }
}

// Directions follow the sum of the densities of all that lies on their line.
TEST_P(Lights, DirectionsFollowTheDensity) {
  const SurfacePoint from = point_at(Vec3(0.1f, 0, 0.2f));
  // Cells of light directions, expected shares by a fine regular grid: the outlines of lights make adaptive integration
  // pointless, so the expectation has a sampling error of its own, about a tenth of the counts' one.
  const SphereGrid grid{6, 12};
  constexpr int samples = 20000, fine = 150;
  std::vector<double> observed(grid.rows * grid.columns + 1), expected(observed.size());
  Random random(3);
  for (int i = 0; i < samples; ++i) {
    const float pick = random.next_1d();
    const std::optional<LightSample> sample = lights_->sample(from, pick, random.next_2d());
    ++observed[sample && !sample->is_delta ? grid.cell_of(sample->wi) : observed.size() - 1];
  }
  double total = 0;
  for (std::size_t cell = 0; cell + 1 < observed.size(); ++cell) {
    double sum = 0;
    for (int i = 0; i < fine * fine; ++i) {
      const Vec2 jitter = random.next_2d();
      const double row = static_cast<double>(cell) / grid.columns;
      const Vec3 direction = grid.direction(std::floor(row) + (i / fine + jitter.y) / fine,
                                            static_cast<double>(cell % grid.columns) + (i % fine + jitter.x) / fine);
      sum += look(from.position, direction).pdf;
    }
    expected[cell] = samples * sum * grid.cell_solid_angle() / (fine * fine);
    total += expected[cell];
  }
  EXPECT_LT(total, 1.005 * samples);
  expected.back() = std::max(0.0, samples - total);
  if (expected.back() < 0.005 * samples) {  // every draw gives a direction, up to the error of the expectation
    EXPECT_LT(observed.back(), 0.005 * samples);
    expected.back() = observed.back();
  }
  EXPECT_GT(chi_square_test(observed, expected).p_value, significance);
}

// A point behind a light gets nothing from it, and no numbers at the rim of [0, 1) make a bad sample, wherever the
// point is: in the plane of a light, at one of its corners, on it.
TEST_P(Lights, ExtremeNumbersAndPlacesGiveSoundSamples) {
  const std::array numbers = {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, one_minus_epsilon};
  for (const Vec3 position : {Vec3(0), Vec3(-1, 2, -0.5f), Vec3(0, 2.5f, 0), Vec3(0, 1.5f, 0), Vec3(-1, 1.5f, 5),
                              Vec3(0, 3, 0), Vec3(0, 1e6f, 0), Vec3(-1.5f, 0.5f, -2)}) {
    for (const float pick : numbers) {
      for (const float x : numbers) {
        for (const float y : numbers) {
          const std::optional<LightSample> sample = lights_->sample(point_at(position), pick, {x, y});
          if (!sample) continue;
          EXPECT_TRUE(is_finite(sample->wi) && is_finite(sample->radiance));
          EXPECT_TRUE(is_finite(sample->shadow_ray.origin) && is_finite(sample->shadow_ray.direction));
          EXPECT_GE(min_component(sample->radiance), 0);
          EXPECT_TRUE(std::isfinite(sample->pdf) && sample->pdf > 0) << sample->pdf;
          EXPECT_GT(sample->shadow_ray.t_max, 0);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Lights, testing::ValuesIn(light_scenes().begin(), light_scenes().end()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace candil::test
