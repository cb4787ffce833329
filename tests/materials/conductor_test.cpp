#include "materials/conductor.h"

#include <gtest/gtest.h>

#include "core/metals.h"
#include "core/sampler.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

Material conductor(const char* metal, float roughness) {
  Material m;
  m.model = MaterialModel::conductor;
  m.roughness = roughness;
  m.conductor_eta = find_metal(metal)->eta;
  m.conductor_k = find_metal(metal)->k;
  return m;
}

// R = ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2). Gold: red 12.2397 / 12.9917, green (0.544 - 2.231 i) (0.2079 + 4.9774)
// / (2.3839 + 4.9774), blue (1.332 - 1.869 i) (0.1102 + 3.4932) / (5.4382 + 3.4932).
TEST(Conductor, SmoothGoldIsAColouredMirror) {
  const ClosureBench bench(conductor("gold", 0));
  const Vec3 wo(0, 0, 1);
  const Bsdf bsdf = bench.bsdf(wo);
  EXPECT_TRUE(bsdf.is_purely_delta());
  const auto sample = bsdf.sample(wo, 0.9f, Vec2(0.3f));
  ASSERT_TRUE(sample && sample->is_delta);
  EXPECT_EQ(sample->pdf, 1);
  EXPECT_NEAR(sample->weight.x, 0.9421f, 1e-4f);
  EXPECT_NEAR(sample->weight.y, 0.7044f, 1e-4f);
  EXPECT_NEAR(sample->weight.z, 0.4035f, 1e-4f);
  EXPECT_EQ(sample->wi, wo);
}

// Metals lose light at each reflection: a rough one, whose light is reflected several times, is a little darker and
// more saturated than a smooth one, never brighter, and not as dark as after three reflections.
TEST(Conductor, RoughnessDarkensGoldALittle) {
  const auto albedo = [](float roughness) {
    const ClosureBench bench(conductor("gold", roughness));
    const Vec3 wo = direction_at(20);
    const Bsdf bsdf = bench.bsdf(wo);
    constexpr std::uint32_t count = 16384;
    Vec3 sum(0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Sampler s({3, 5}, i, 11);
      const auto sample = bsdf.sample(wo, s.sample_2d(0).x, s.sample_2d(1));
      if (sample) sum += sample->weight;
    }
    return sum / static_cast<float>(count);
  };
  const Vec3 smooth = albedo(0), satin = albedo(0.2f), rough = albedo(1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(satin[c], smooth[c], 0.005f) << "channel " << c;
    EXPECT_LT(rough[c], smooth[c] + 0.005f) << "channel " << c;
    EXPECT_GT(rough[c], smooth[c] * smooth[c] * smooth[c]) << "channel " << c;
  }
  EXPECT_GT(rough.x / rough.z, smooth.x / smooth.z);
}

TEST(Conductor, TintMultipliesWhatIsReflected) {
  for (const float roughness : {0.0f, 0.5f}) {
    Material tinted = conductor("silver", roughness);
    tinted.base_color = Vec4(0.5f, 0.25f, 0.125f, 1);
    const ClosureBench plain_bench(conductor("silver", roughness)), tinted_bench(tinted);
    const Vec3 wo = direction_at(40), wi(-wo.x, -wo.y, wo.z);
    const Vec3 plain_value = plain_bench.bsdf(wo).eval(wo, wi).f_cos, value = tinted_bench.bsdf(wo).eval(wo, wi).f_cos;
    const Vec3 plain_albedo = plain_bench.bsdf(wo).albedo(), albedo = tinted_bench.bsdf(wo).albedo();
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(value[c], plain_value[c] * tinted.base_color[c]);
      EXPECT_FLOAT_EQ(albedo[c], plain_albedo[c] * tinted.base_color[c]);
    }
  }
}

}  // namespace
}  // namespace candil::test
