#include "materials/shadow_terminator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sampler.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

const Vec3 bent_normal = glm::normalize(Vec3(0.6f, 0, 0.8f));

Material diffuse() {
  Material m;
  m.metallic = m.specular = 0;
  return m;
}

// The factor of the paper (equation 3): g = min(1, cos_geometric / (cos_shading cos_normals)), -g^3 + g^2 + g.
TEST(ShadowTerminator, IsThePapersFactor) {
  EXPECT_FLOAT_EQ(ShadowTerminator::factor(0.5f, 0.2f, 0.8f), 0.625f);  // g = 1/2: -1/8 + 1/4 + 1/2
  EXPECT_EQ(ShadowTerminator::factor(0.5f, 0.0f, 0.8f), 0);
  EXPECT_EQ(ShadowTerminator::factor(0.5f, -0.3f, 0.8f), 0);
  EXPECT_EQ(ShadowTerminator::factor(0.5f, 0.9f, 0.8f), 1);
  EXPECT_EQ(ShadowTerminator().factor(Vec3(0.6f, 0, 0.8f)), 1);
}

// Light that sinks below the flat surface while the bent normal still sees it fades out instead of going out: over the
// last degree above the horizon, steps of 0.1 degrees change the value by less than 5 % of what it is at the zenith.
TEST(ShadowTerminator, LightFadesTowardsTheHorizon) {
  const ClosureBench bench(diffuse(), bent_normal);
  const Vec3 wo(0, 0, 1);
  const Bsdf bsdf = bench.bsdf(wo);
  const float zenith = bsdf.eval(wo, Vec3(0, 0, 1)).f_cos.x;
  float previous = 0;
  for (float height = 0; height < 30; height += 0.1f) {
    const float theta = glm::radians(90 - height);
    const float value = bsdf.eval(wo, Vec3(std::sin(theta), 0, std::cos(theta))).f_cos.x;
    EXPECT_NEAR(value, previous, 0.05f * zenith) << height << " degrees above the horizon";
    previous = value;
  }
  EXPECT_GT(previous, 0.5f * zenith);
}

// Never more than f cos of the bent normal alone, and for the same cosine with both normals exactly that.
TEST(ShadowTerminator, MakesNoEnergy) {
  const ClosureBench bench(diffuse(), bent_normal);
  const Vec3 wo(0, 0, 1);
  const Bsdf bsdf = bench.bsdf(wo);
  int softened = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const auto sample = bsdf.sample(wo, 0.5f, Sampler({3, 5}, i, 11).sample_2d(0));
    if (!sample) continue;
    EXPECT_GT(sample->wi.z, 0);
    EXPECT_LE(sample->weight.x, 1);
    EXPECT_NEAR(sample->weight.x * sample->pdf, bsdf.eval(wo, sample->wi).f_cos.x, 1e-5f);
    softened += sample->weight.x < 1;
  }
  EXPECT_GT(softened, 50);
}

// sample() and eval() of all closures agree under a bent normal too.
TEST(ShadowTerminator, WeightTimesPdfIsWhatEvalSays) {
  for (const NamedMaterial& named : rough_materials()) {
    const ClosureBench bench(named.material, bent_normal);
    const Vec3 wo = direction_at(35);
    const Bsdf bsdf = bench.bsdf(wo);
    for (std::uint32_t i = 0; i < 100; ++i) {
      const Sampler s({3, 5}, i, 11);
      const auto sample = bsdf.sample(wo, s.sample_2d(0).x, s.sample_2d(1));
      if (!sample || sample->is_delta) continue;
      const BsdfEval value = bsdf.eval(wo, sample->wi);
      ASSERT_NEAR(value.pdf, sample->pdf, 3e-3f * sample->pdf) << named.name;
      for (int c = 0; c < 3; ++c) {
        const float f_cos = sample->weight[c] * sample->pdf;
        ASSERT_NEAR(value.f_cos[c], f_cos, 3e-3f * f_cos + 1e-6f) << named.name;
      }
    }
  }
}

}  // namespace
}  // namespace candil::test
