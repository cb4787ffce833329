// KHR_materials_diffuse_transmission as a closure: energy, both sides, and what it leaves alone.
#include <gtest/gtest.h>

#include "core/sampler.h"
#include "materials/bsdf.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

Material translucent(float share, float roughness = 0.5f) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.extensions.emplace().diffuse_transmission = share;
  return m;
}

// White stays white whatever share goes through, from either side and at grazing angles.
TEST(DiffuseTransmission, WhiteKeepsItsEnergyForEveryShare) {
  for (const float share : {0.25f, 0.5f, 1.0f}) {
    for (const float roughness : {0.0f, 0.05f, 0.1f, 0.4f, 1.0f}) {
      const ClosureBench bench(translucent(share, roughness));
      for (const float angle : {0.0f, 60.0f, 85.0f, 89.5f, 91.0f, 150.0f}) {
        const Vec3 wo = direction_at(angle);
        const Bsdf bsdf = bench.bsdf(wo);
        float energy = 0, through = 0;
        constexpr std::uint32_t count = 16384;
        for (std::uint32_t i = 0; i < count; ++i) {
          const Sampler s({3, 5}, i, 11);
          const auto sample = bsdf.sample(wo, s.sample_2d(0).x, s.sample_2d(1));
          if (!sample) continue;
          EXPECT_EQ(sample->is_transmission, sample->wi.z * wo.z < 0);
          EXPECT_EQ(sample->eta, 1);
          energy += sample->weight.x / count;
          if (sample->is_transmission) through += sample->weight.x / count;
        }
        EXPECT_GT(energy, 0.99f) << share << " roughness " << roughness << " at " << angle;
        EXPECT_LT(energy, 1.005f) << share << " roughness " << roughness << " at " << angle;
        EXPECT_LT(through, share + 0.005f);
        EXPECT_GT(through, 0.03f * share);
      }
    }
  }
}

// Without a coat the text's formulas stand alone: (1 - share) base / pi on this side, share color / pi beyond.
TEST(DiffuseTransmission, WithoutCoatIsTheFormula) {
  Material m = translucent(0.3f);
  m.specular = 0;
  m.base_color = Vec4(0.2f, 0.5f, 0.8f, 1);
  m.extensions->diffuse_transmission_color = Vec3(0.9f, 0.6f, 0.1f);
  const ClosureBench bench(m);
  for (const float angle : {40.0f, 140.0f}) {
    const Vec3 wo = direction_at(angle), here = direction_at(angle < 90 ? 20.0f : 160.0f), beyond = -here;
    const Bsdf bsdf = bench.bsdf(wo);
    const float cosine = std::abs(here.z);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(bsdf.eval(wo, here).f_cos[c], 0.7f * m.base_color[c] / pi * cosine, 1e-6f);
      EXPECT_NEAR(bsdf.eval(wo, beyond).f_cos[c], 0.3f * m.extensions->diffuse_transmission_color[c] / pi * cosine,
                  1e-6f);
    }
  }
}

// Metal, and what refracts instead, let nothing through here.
TEST(DiffuseTransmission, IsForTheDiffuseBaseAlone) {
  Material m = translucent(1);
  m.metallic = 1;
  const Vec3 wo = direction_at(30), beyond = direction_at(160);
  EXPECT_EQ(ClosureBench(m).bsdf(wo).eval(wo, beyond).f_cos, Vec3(0));
  m = translucent(1);
  m.transmission = 1;
  Material sheet = m;
  sheet.extensions.reset();
  const float through = ClosureBench(sheet).bsdf(wo).eval(wo, beyond).f_cos.x;
  EXPECT_NEAR(ClosureBench(m).bsdf(wo).eval(wo, beyond).f_cos.x, through, 0.01f * through) << "finer tables";
}

// Under a bent normal light from behind fades towards the horizon of the back as it does in front.
TEST(DiffuseTransmission, ShadowTerminatorIsTheSameOnBothSides) {
  Material m = translucent(0.5f);
  m.specular = 0;
  const ClosureBench bench(m, glm::normalize(Vec3(0.6f, 0, 0.8f)));
  const Vec3 wo(0, 0, 1);
  const Bsdf bsdf = bench.bsdf(wo);
  int softened = 0;
  for (int degrees = -89; degrees < 90; ++degrees) {
    const float theta = glm::radians(static_cast<float>(degrees));
    const Vec3 front(std::sin(theta), 0, std::cos(theta));
    const float value = bsdf.eval(wo, front).f_cos.x;
    EXPECT_NEAR(bsdf.eval(wo, -front).f_cos.x, value, 1e-6f) << degrees;
    const float unsoftened = 0.5f / pi * glm::max(0.0f, glm::dot(front, bsdf.shading_normal()));
    softened += value < 0.99f * unsoftened;
  }
  EXPECT_GT(softened, 10);
}

}  // namespace
}  // namespace candil::test
