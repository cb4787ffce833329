// Random walks in scattering volumes, step by step.
#include "integrators/medium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/chi_square.h"

namespace candil::test {
namespace {

Material volume(Vec3 attenuation, float distance, Vec3 multiscatter) {
  Material m;
  m.transmission = m.thickness = 1;
  m.attenuation_color = attenuation;
  m.attenuation_distance = distance;
  m.extensions.emplace().multiscatter_color = multiscatter;
  return m;
}

// The text: extinction is -log(c) / d. For the albedo of one event, van de Hulst's approximation of what a half space
// of isotropic scatterers returns, which the fit inverts: (1 - s)(1 - 0.139 s) / (1 + 1.17 s), s^2 = 1 - albedo.
TEST(Medium, FollowsFromAttenuationAndMultiscatterColor) {
  for (const float color : {0.1f, 0.5f, 0.9f}) {
    const Medium medium = medium_of(volume(Vec3(0.9f, 0.5f, 1), 0.1f, Vec3(color, 0, 1)));
    EXPECT_NEAR(medium.extinction.x, -std::log(0.9f) / 0.1f, 1e-5f);
    EXPECT_NEAR(medium.extinction.y, std::log(2.0f) / 0.1f, 1e-5f);
    EXPECT_EQ(medium.extinction.z, 0);
    const float s = std::sqrt(1 - medium.albedo.x);
    EXPECT_NEAR((1 - s) * (1 - 0.139f * s) / (1 + 1.17f * s), color, 0.01f);
    EXPECT_NEAR(medium.albedo.y, 0, 1e-4f);
    EXPECT_NEAR(medium.albedo.z, 1, 1e-4f);
  }
  EXPECT_FALSE(volume(Vec3(0.5f), 1, Vec3(0)).scatters());
  EXPECT_FALSE(volume(Vec3(0.5f), infinity, Vec3(0.5f)).scatters()) << "nothing to scatter from";
  // As dense as numbers go, and still made of numbers.
  const Medium black = medium_of(volume(Vec3(0), 1e-38f, Vec3(0.5f)));
  EXPECT_TRUE(is_finite(black.extinction));
}

struct Walk {
  glm::dvec3 passed{0}, all{0};
  float largest = 0;  // sum of a throughput's channels
};

/// Means of the throughput after one step towards a surface, of those that reach it and of all.
Walk walk(const Medium& medium, float distance, Vec3 throughput, std::uint32_t count) {
  Walk result;
  for (std::uint32_t i = 0; i < count; ++i) {
    PathState state;
    state.throughput = throughput;
    const MediumStep step = step_in_medium(state, medium, distance, Sampler({1, 2}, i, 3));
    if (step == MediumStep::ended) continue;
    result.largest = glm::max(result.largest, state.throughput.x + state.throughput.y + state.throughput.z);
    const glm::dvec3 share = glm::dvec3(state.throughput) / static_cast<double>(count);
    result.all += share;
    if (step == MediumStep::surface) result.passed += share;
  }
  return result;
}

// Beer and Lambert's law for what crosses a slab unscattered; and what does not is scattered by the albedo. Weights are
// bounded by 3, so that 65536 independent numbers would have a standard error below 3 / 256 / 2.
TEST(Medium, SlabLetsThroughWhatBeerAndLambertSay) {
  const Medium medium{Vec3(0.5f, 2, 8), Vec3(1, 0.8f, 0.3f), 0.2f};
  for (const float distance : {0.1f, 1.0f}) {
    const Walk result = walk(medium, distance, Vec3(1), 65536);
    for (int c = 0; c < 3; ++c) {
      const double passed = std::exp(-medium.extinction[c] * distance);
      EXPECT_NEAR(result.passed[c], passed, 0.01) << "channel " << c;
      EXPECT_NEAR(result.all[c], passed + medium.albedo[c] * (1 - passed), 0.015) << "channel " << c;
    }
    EXPECT_LE(result.largest, 3.0001f);
  }
}

// Channels of no throughput stay black, whatever their density.
TEST(Medium, BlackChannelsStayBlack) {
  const Medium medium{Vec3(100, 1e12f, 0), Vec3(0.5f), 0};
  for (const Vec3 throughput : {Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3), Vec3(0.5f, 0, 1)}) {
    const Walk result = walk(medium, 0.01f, throughput, 4096);
    for (int c = 0; c < 3; ++c) {
      const double passed = std::exp(-static_cast<double>(medium.extinction[c]) * 0.01);
      EXPECT_NEAR(result.passed[c], throughput[c] * passed, 0.1 * throughput[c]);
      EXPECT_TRUE(std::isfinite(result.all[c]));
    }
  }
}

// Directions have the density of the phase function, which integrates to 1; their mean cosine is g.
TEST(Medium, DirectionsFollowThePhaseFunction) {
  const Vec3 along = glm::normalize(Vec3(1, -2, 0.5f));
  for (const float g : {0.0f, 0.6f, -0.6f, 0.95f}) {
    double mean_cosine = 0;
    constexpr int count = 50000;
    const auto sample = [&](Random& random) -> std::optional<Vec3> {
      const Vec3 w = sample_henyey_greenstein(along, g, random.next_2d());
      mean_cosine += static_cast<double>(glm::dot(w, along)) / count;
      return w;
    };
    const auto pdf = [&](Vec3 w) { return henyey_greenstein(glm::dot(w, along), g); };
    EXPECT_GT(test_directions(sample, pdf, count, 7, SphereGrid{12, 24}).p_value, significance) << g;
    EXPECT_NEAR(mean_cosine, g, 0.02) << "standard error at most 0.0026";
  }
}

}  // namespace
}  // namespace candil::test
