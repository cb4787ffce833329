// The report's dielectrics: smooth, in a medium. A scene divides the index of refraction by that of its medium, so that
// glass in air has 1.5 / 1.000293, and a bubble of air in glass 1 / 1.5.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/bsdf.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

constexpr float air = 1.000293f;

Material dielectric(float ior, float roughness = 0) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.transmission = 1;
  m.thickness = 1;
  m.ior = ior;
  return m;
}

struct Expected {
  float ior;          // relative
  float degrees;      // of wo
  float reflectance;  // Fresnel's
  float sine;         // of the refracted angle, Snell's
};

// Relative indices 1.5 / 1.000293 = 1.499561 and 2.42 / 1.000293 = 2.419291. At 0 degrees R = ((n - 1) / (n + 1))^2. At
// 45 degrees r_s = (cos 45 - n cos t) / (cos 45 + n cos t) with sin t = sin 45 / n, and r_p = r_s^2 (a coincidence of
// 45 degrees): glass sin t = 0.471543, cos t = 0.881843, r_s^2 = 0.091910, R = (0.091910 + 0.008447) / 2; diamond sin t
// = 0.292278, cos t = 0.956333, r_s^2 = 0.282848, R = (0.282848 + 0.080003) / 2. From inside the same rays run
// backwards.
constexpr Expected table[] = {
    {1.5f / air, 0, 0.039944f, 0},
    {1.5f / air, 45, 0.050179f, 0.471543f},
    {2.42f / air, 0, 0.172294f, 0},
    {2.42f / air, 45, 0.181425f, 0.292278f},
    {1.5f / air, 180, 0.039944f, 0},
    {1.5f / air, 180 - 28.134479f, 0.050179f, 0.707107f},
    // A bubble in glass, seen from the glass, is the inside of glass: asin(sin 45 / 1.5) = 28.125506 degrees. As above
    // with n = 1.5: sin t = 0.471405, cos t = 0.881917, r_s^2 = 0.092013, R = 0.050240.
    {1 / 1.5f, 28.125506f, 0.050240f, 0.707107f},
    {1 / 1.5f, 180 - 45, 0.050240f, 0.471405f},
};

TEST(DielectricIndex, SnellAndFresnel) {
  for (const Expected& expected : table) {
    const ClosureBench bench(dielectric(expected.ior));
    const Vec3 wo = direction_at(expected.degrees);
    const Bsdf bsdf = bench.bsdf(wo);
    const auto reflected = bsdf.sample(wo, 0, Vec2(0.5f)), refracted = bsdf.sample(wo, 0.9999f, Vec2(0.5f));
    ASSERT_TRUE(reflected && refracted);
    EXPECT_NEAR(reflected->pdf, expected.reflectance, 3e-6f) << expected.ior << " at " << expected.degrees;
    EXPECT_NEAR(refracted->pdf, 1 - expected.reflectance, 3e-6f);
    EXPECT_FALSE(reflected->is_transmission);
    EXPECT_TRUE(refracted->is_transmission);
    EXPECT_NEAR(std::hypot(refracted->wi.x, refracted->wi.y), expected.sine, 2e-6f);
    EXPECT_LT(refracted->wi.z * wo.z, 0);
    // No light is lost: F / F, and (1 - F) / (1 - F) with the radiance's 1 / eta^2.
    EXPECT_NEAR(reflected->weight.x, 1, 1e-6f);
    EXPECT_NEAR(refracted->weight.x * sqr(refracted->eta), 1, 1e-5f);
    EXPECT_NEAR(refracted->eta, wo.z > 0 ? expected.ior : 1 / expected.ior, 1e-6f);
  }
}

// Beyond asin(1 / n) on the denser side nothing is refracted: glass in air 41.825 degrees, diamond in air 24.415, and a
// bubble from outside 41.810. Half a degree on either side.
TEST(DielectricIndex, TotalInternalReflection) {
  struct {
    float ior, critical;
    bool is_from_inside;
  } const cases[] = {{1.5f / air, 41.825f, true}, {2.42f / air, 24.415f, true}, {1 / 1.5f, 41.810f, false}};
  for (const auto& c : cases) {
    const ClosureBench bench(dielectric(c.ior));
    const auto transmits = [&](float degrees) {
      const Vec3 wo = direction_at(c.is_from_inside ? 180 - degrees : degrees);
      const auto sample = bench.bsdf(wo).sample(wo, 0.9999f, Vec2(0.5f));
      EXPECT_TRUE(sample);
      return sample && sample->is_transmission;
    };
    EXPECT_TRUE(transmits(c.critical - 0.5f)) << c.ior;
    EXPECT_FALSE(transmits(c.critical + 0.5f)) << c.ior;
  }
}

// The same index on both sides: straight through, whatever the roughness.
TEST(DielectricIndex, WaterInWaterIsInvisible) {
  for (const float roughness : {0.0f, 0.5f}) {
    const ClosureBench bench(dielectric(1.33f / 1.33f, roughness));
    for (const float angle : {0.0f, 70.0f, 150.0f}) {
      const Vec3 wo = direction_at(angle);
      const Bsdf bsdf = bench.bsdf(wo);
      EXPECT_TRUE(bsdf.is_purely_delta());
      const auto sample = bsdf.sample(wo, 0.01f, Vec2(0.5f));
      ASSERT_TRUE(sample && sample->is_transmission);
      EXPECT_NEAR(glm::dot(sample->wi, wo), -1, 1e-6f);
      EXPECT_NEAR(sample->weight.x, 1, 1e-6f);
    }
  }
}

// A normal map may turn a refracted direction to the wrong side of the surface: it is bent, not lost.
TEST(DielectricIndex, BentNormalsLoseNoLight) {
  const ClosureBench bench(dielectric(1.5f), glm::normalize(Vec3(0.8f, 0, 0.6f)));
  int bent = 0;
  for (int degrees = 91; degrees < 180; ++degrees) {
    const float theta = glm::radians(static_cast<float>(degrees));
    for (const float side : {-1.0f, 1.0f}) {
      const Vec3 wo(side * std::sin(theta), 0, std::cos(theta));
      const Bsdf bsdf = bench.bsdf(wo);
      for (const float u : {0.0f, 0.9999f}) {
        const auto sample = bsdf.sample(wo, u, Vec2(0.5f));
        ASSERT_TRUE(sample) << degrees;
        EXPECT_EQ(sample->is_transmission, sample->wi.z > 0) << degrees;
        EXPECT_NEAR(glm::length(sample->wi), 1, 1e-5f);
        bent += sample->is_transmission && sample->wi.z < 1.001e-3f;
      }
    }
  }
  EXPECT_GT(bent, 0) << "the normal is not steep enough to test anything";
}

}  // namespace
}  // namespace candil::test
