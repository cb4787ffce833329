// KHR_materials_dispersion as a closure.
#include <gtest/gtest.h>

#include <cmath>

#include "core/sampler.h"
#include "materials/bsdf.h"
#include "tests/support/chi_square.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

Material prism_glass(float roughness, float dispersion) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.transmission = m.thickness = 1;
  m.extensions.emplace().dispersion = dispersion;
  return m;
}

float sine(Vec3 w) { return std::hypot(w.x, w.y); }

// Snell's law with the index of the wavelength, on the way in and out: for n_d = 1.5 and V_d = 20, n_F = 1.5 + 0.5 / 20
// (523655 / 486.13^2 - 1.5168) = 1.517476 and n_C = 1.492476.
TEST(Dispersion, RefractsByTheIndexOfTheWavelength) {
  const ClosureBench bench(prism_glass(0, 1));
  const Vec3 outside = direction_at(40), inside = direction_at(160);
  for (const auto& [nanometres, ior] : {std::pair(486.13f, 1.517476f), std::pair(656.27f, 1.492476f)}) {
    const Wavelength wavelength{nanometres};
    const auto in = bench.bsdf(outside, wavelength).sample(outside, 0.9999f, Vec2(0.5f));
    const auto out = bench.bsdf(inside, wavelength).sample(inside, 0.9999f, Vec2(0.5f));
    ASSERT_TRUE(in && out && in->is_transmission && out->is_transmission);
    EXPECT_NEAR(sine(in->wi), sine(outside) / ior, 2e-6f);
    EXPECT_NEAR(in->eta, ior, 2e-6f);
    EXPECT_NEAR(sine(out->wi), sine(inside) * ior, 2e-6f);
  }
}

// From outside, reflection is the same for all wavelengths and keeps its colour; the response goes with what enters.
TEST(Dispersion, OnlyWhatEntersHasAColour) {
  for (const float roughness : {0.0f, 0.5f}) {
    const ClosureBench bench(prism_glass(roughness, 1)), plain(prism_glass(roughness, 0));
    const Vec3 wo = direction_at(40);
    const Bsdf bsdf = bench.bsdf(wo, {450, Vec3(0, 0.5f, 2.5f)}), white = bench.bsdf(wo, {450});
    if (roughness > 0) {
      const Vec3 up = direction_at(30), down = direction_at(165);
      const Vec3 reflected = bsdf.eval(wo, up).f_cos, expected = plain.bsdf(wo).eval(wo, up).f_cos;
      EXPECT_EQ(reflected, Vec3(reflected.x));
      EXPECT_NEAR(reflected.x, expected.x, 0.01f * expected.x) << "finer tables";
      const Vec3 through = bsdf.eval(wo, down).f_cos, unweighted = white.eval(wo, down).f_cos;
      EXPECT_EQ(through.x, 0);
      EXPECT_NEAR(through.z, 2.5f * unweighted.z, 1e-5f * through.z);
    } else {
      const auto reflected = bsdf.sample(wo, 0, Vec2(0.5f)), through = bsdf.sample(wo, 0.9999f, Vec2(0.5f));
      ASSERT_TRUE(reflected && through);
      const float reflectance = 1 - white.sample(wo, 0.9999f, Vec2(0.5f))->pdf;
      EXPECT_NEAR(reflected->weight.x * reflected->pdf, reflectance, 1e-6f);
      EXPECT_NEAR(reflected->weight.z * reflected->pdf, reflectance, 1e-6f);
      EXPECT_EQ(through->weight.x, 0);
      EXPECT_NEAR(through->weight.z * through->pdf * sqr(through->eta), 2.5f * (1 - reflectance), 1e-5f);
    }
  }
}

// Every wavelength keeps its energy, also of glass that disperses more than any real one.
TEST(Dispersion, EveryWavelengthKeepsItsEnergy) {
  for (const auto& [dispersion, roughness] : {std::pair(1.0f, 0.0f), std::pair(1.0f, 0.08f), std::pair(1.0f, 0.5f),
                                              std::pair(1.0f, 1.0f), std::pair(4.0f, 0.25f), std::pair(4.0f, 1.0f)}) {
    const ClosureBench bench(prism_glass(roughness, dispersion));
    for (const float nanometres : {400.0f, 680.0f}) {
      for (const float angle : {0.0f, 60.0f, 85.0f, 89.0f, 91.0f, 120.0f, 140.0f, 180.0f}) {
        const Vec3 wo = direction_at(angle);
        const Bsdf bsdf = bench.bsdf(wo, {nanometres});
        float energy = 0;
        constexpr std::uint32_t count = 32768;
        for (std::uint32_t i = 0; i < count; ++i) {
          const Sampler s({3, 5}, i, 11);
          const auto sample = bsdf.sample(wo, s.sample_2d(0).x, s.sample_2d(1));
          if (sample) energy += sample->weight.x * sqr(sample->eta) / count;
        }
        EXPECT_GT(energy, 0.99f) << dispersion << " " << roughness << " " << nanometres << " nm at " << angle;
        EXPECT_LT(energy, 1.005f) << dispersion << " " << roughness << " " << nanometres << " nm at " << angle;
      }
    }
  }
}

TEST(Dispersion, RoughSamplesFollowTheirDensity) {
  const ClosureBench bench(prism_glass(0.5f, 2));
  for (const float angle : {30.0f, 75.0f, 125.0f}) {
    const Vec3 wo = direction_at(angle);
    const Bsdf bsdf = bench.bsdf(wo, {420, Vec3(0.2f, 0, 2.8f)});
    const auto sample = [&](Random& random) -> std::optional<Vec3> {
      const float u_lobe = random.next_1d();
      const auto drawn = bsdf.sample(wo, u_lobe, random.next_2d());
      return drawn ? std::optional(drawn->wi) : std::nullopt;
    };
    const auto pdf = [&](Vec3 wi) { return bsdf.eval(wo, wi).pdf; };
    EXPECT_GT(test_directions(sample, pdf, 50000, 7, SphereGrid{12, 24}).p_value, significance) << angle;
  }
}

}  // namespace
}  // namespace candil::test
