// The coat by the words of KHR_materials_clearcoat, and glass below it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

Material coated(Material m, float roughness = 0) {
  m.extensions.emplace();
  m.extensions->clearcoat = 1;
  m.extensions->clearcoat_roughness = roughness;
  return m;
}

Material black() {
  Material m;
  m.metallic = 0, m.specular = 0;
  m.base_color = Vec4(0, 0, 0, 1);
  return m;
}

Material smooth_glass() {
  Material m;
  m.metallic = 0, m.roughness = 0, m.transmission = 1, m.thickness = 1;
  return m;
}

double schlick(double cosine) { return 0.04 + 0.96 * std::pow(1 - cosine, 5); }

// On black nothing but the coat is left. Smith's shadowing is 1 at alpha = 0.01 away from grazing angles, and D at the
// peak is 1 / (pi alpha^2): f cos = F D / (4 cos).
TEST(Clearcoat, HasTheSpecularLobeOfTheSpecification) {
  const ClosureBench bench(coated(black(), 0.1f));
  for (const float angle : {0.0f, 30.0f, 60.0f}) {
    const Vec3 wo = direction_at(angle), wi(-wo.x, -wo.y, wo.z);
    const double expected = schlick(wo.z) / (pi * 1e-4) / (4 * wo.z);
    EXPECT_NEAR(bench.bsdf(wo).eval(wo, wi).f_cos.x / expected, 1, 2e-3) << angle;
  }
}

// What goes in by one way comes out by the same: the factor (1 - F) of a smooth coat on smooth glass is that of the
// direction outside, whichever side is asked.
TEST(Clearcoat, AttenuatesSmoothGlassAlikeFromBothSides) {
  const ClosureBench plain(smooth_glass()), coat(coated(smooth_glass()));
  const auto transmittance = [](const ClosureBench& bench, Vec3 wo) {
    const auto sample = bench.bsdf(wo).sample(wo, 0.9999f, Vec2(0.5f));
    EXPECT_TRUE(sample && sample->is_transmission && sample->is_delta);
    return sample ? sample->weight.x * sample->pdf : 0.0f;
  };
  for (const float angle : {0.0f, 30.0f, 60.0f, 80.0f}) {
    const Vec3 outside = direction_at(angle),
               inside(outside.x / 1.5f, outside.y / 1.5f, -std::sqrt(1 - (1 - outside.z * outside.z) / 2.25f));
    const double expected = 1 - schlick(outside.z);
    EXPECT_NEAR(transmittance(coat, outside) / transmittance(plain, outside), expected, 1e-4) << angle;
    EXPECT_NEAR(transmittance(coat, inside) / transmittance(plain, inside), expected, 1e-4) << angle;
  }
}

// Total internal reflection never meets the coat.
TEST(Clearcoat, ChangesNothingBeyondTheCriticalAngle) {
  const ClosureBench coat(coated(smooth_glass()));
  const Vec3 wo = direction_at(180 - 45);
  const auto sample = coat.bsdf(wo).sample(wo, 0.999f, Vec2(0.5f));
  ASSERT_TRUE(sample);
  EXPECT_FALSE(sample->is_transmission);
  EXPECT_NEAR(sample->weight.x, 1, 1e-6f);
}

TEST(Clearcoat, OfSmoothGlassLeavesNothingToLightSampling) {
  const Vec3 wo = direction_at(30);
  EXPECT_TRUE(ClosureBench(coated(smooth_glass())).bsdf(wo).is_purely_delta());
  EXPECT_FALSE(ClosureBench(coated(smooth_glass(), 0.5f)).bsdf(wo).is_purely_delta());
  EXPECT_TRUE(ClosureBench(coated(black())).bsdf(wo).is_purely_delta());
}

}  // namespace
}  // namespace candil::test
