#include "materials/phong.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sampler.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

Material phong(Vec3 kd, Vec3 ks, float exponent) {
  Material m;
  m.model = MaterialModel::phong;
  m.base_color = Vec4(kd, 1);
  m.specular_color = ks;
  m.phong_exponent = exponent;
  return m;
}

/// Energy towards wo for light 1 from everywhere, by importance sampling.
Vec3 albedo(const Material& material, Vec3 wo, std::uint32_t samples) {
  const ClosureBench bench(material);
  const Bsdf bsdf = bench.bsdf(wo);
  Vec3 sum(0);
  for (std::uint32_t i = 0; i < samples; ++i) {
    const Sampler s({3, 5}, i, 11);
    const auto sample = bsdf.sample(wo, s.sample_2d(0).x, s.sample_2d(1));
    if (sample) sum += sample->weight;
  }
  return sum / static_cast<float>(samples);
}

// kd / pi + ks (n + 2) / (2 pi) cos^n a. wo at 30 degrees, wi at 50 degrees on the other side of the normal: a = 20.
TEST(Phong, IsTheFormula) {
  const ClosureBench bench(phong(Vec3(0.65f), Vec3(0.2f), 50));
  const float degree = pi / 180;
  const Vec3 wo(std::sin(30 * degree), 0, std::cos(30 * degree)), wi(-std::sin(50 * degree), 0, std::cos(50 * degree));
  // 0.65 / pi = 0.206901; 0.2 x 52 / (2 pi) = 1.655211; cos(20)^50 = 0.0445955; f = 0.206901 + 0.073815 = 0.280716.
  EXPECT_NEAR(bench.bsdf(wo).eval(wo, wi).f_cos.x, 0.280716f * std::cos(50 * degree), 1e-5f);
  // Beyond 90 degrees from the mirror direction only the diffuse part is left.
  const Vec3 back(std::sin(70 * degree), 0, std::cos(70 * degree));
  EXPECT_NEAR(bench.bsdf(wo).eval(wo, back).f_cos.x, 0.206901f * std::cos(70 * degree), 1e-6f);
}

// At normal incidence the specular albedo is ks (n + 2) times the integral of cos^(n + 1) sin, which is 1 / (n + 2).
TEST(Phong, AlbedoIsKdPlusKsAtNormalIncidenceAndNeverMore) {
  for (const float exponent : {0.0f, 2.0f, 50.0f, 250.0f, 1e5f}) {
    const Material m = phong(Vec3(0.6f, 0.3f, 0.1f), Vec3(0.4f, 0.5f, 0.9f), exponent);
    const Vec3 most = Vec3(m.base_color) + m.specular_color;
    const Vec3 normal = albedo(m, Vec3(0, 0, 1), 16384);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(normal[c], most[c], 0.002f) << exponent;
    for (const float angle : {15.0f, 45.0f, 60.0f, 80.0f, 89.0f}) {
      const Vec3 energy = albedo(m, direction_at(angle), 16384);
      for (int c = 0; c < 3; ++c) EXPECT_LT(energy[c], most[c] + 0.002f) << exponent << " at " << angle;
    }
  }
}

// f_cos of sample() and eval() agree even where one float step of the cosine would change cos^n by 1 %.
TEST(Phong, NarrowLobesAreExact) {
  const ClosureBench bench(phong(Vec3(0), Vec3(1), 2e5f));
  for (const float angle : {0.0f, 40.0f, 75.0f}) {
    const Vec3 wo = direction_at(angle);
    const Bsdf bsdf = bench.bsdf(wo);
    for (std::uint32_t i = 0; i < 500; ++i) {
      const auto sample = bsdf.sample(wo, 0.5f, Sampler({3, 5}, i, 11).sample_2d(0));
      ASSERT_TRUE(sample);
      const BsdfEval value = bsdf.eval(wo, sample->wi);
      EXPECT_NEAR(value.pdf, sample->pdf, 5e-3f * sample->pdf);
      // f cos / pdf = ks (n + 2) / (n + 1) cos.
      EXPECT_NEAR(sample->weight.x, 200002.0f / 200001.0f * sample->wi.z, 1e-4f);
    }
  }
}

TEST(Phong, InfiniteExponentIsAMirror) {
  const ClosureBench bench(phong(Vec3(0), Vec3(0.9f, 0.5f, 0.1f), infinity));
  const Vec3 wo = direction_at(70);
  const Bsdf bsdf = bench.bsdf(wo);
  EXPECT_TRUE(bsdf.is_purely_delta());
  EXPECT_FLOAT_EQ(bsdf.survival_probability(), 0.9f);
  const auto sample = bsdf.sample(wo, 0.7f, Vec2(0.3f));
  ASSERT_TRUE(sample && sample->is_delta);
  EXPECT_EQ(sample->pdf, 1);
  EXPECT_NEAR(glm::length(sample->wi - Vec3(-wo.x, -wo.y, wo.z)), 0, 1e-6f);
  EXPECT_NEAR(glm::length(sample->weight - Vec3(0.9f, 0.5f, 0.1f)), 0, 1e-6f);
}

// Lobes are chosen in proportion to max(kd) = 0.6 and max(ks) = 0.2: below 1/4 the mirror.
TEST(Phong, PlasticIsDiffuseAndMirror) {
  const ClosureBench bench(phong(Vec3(0.6f, 0.3f, 0.3f), Vec3(0.2f), infinity));
  const Vec3 wo = direction_at(30), wi = direction_at(65);
  const Bsdf bsdf = bench.bsdf(wo);
  EXPECT_FALSE(bsdf.is_purely_delta());
  EXPECT_NEAR(bsdf.survival_probability(), 0.8f, 1e-6f);
  EXPECT_NEAR(bsdf.eval(wo, wi).f_cos.x, 0.6f / pi * wi.z, 1e-6f);
  EXPECT_NEAR(bsdf.eval(wo, wi).pdf, 0.75f / pi * wi.z, 1e-6f);
  const auto mirrored = bsdf.sample(wo, 0.249f, Vec2(0.3f)), diffuse = bsdf.sample(wo, 0.251f, Vec2(0.3f));
  ASSERT_TRUE(mirrored && diffuse);
  EXPECT_TRUE(mirrored->is_delta);
  EXPECT_NEAR(mirrored->weight.x, 0.2f / 0.25f, 1e-6f);
  EXPECT_FALSE(diffuse->is_delta);
  EXPECT_NEAR(diffuse->weight.x, 0.6f / 0.75f, 1e-6f);
}

// Whatever textures do: ks gives way where kd + ks would exceed 1.
TEST(Phong, TooMuchReflectanceIsTakenFromTheSpecular) {
  const ClosureBench bench(phong(Vec3(0.9f, 0.5f, 1.0f), Vec3(0.5f), infinity));
  const Vec3 albedo = bench.bsdf(Vec3(0, 0, 1)).albedo();
  EXPECT_NEAR(albedo.x, 1, 1e-6f);  // 0.9 + 0.1
  EXPECT_NEAR(albedo.y, 1, 1e-6f);  // 0.5 + 0.5
  EXPECT_NEAR(albedo.z, 1, 1e-6f);  // 1 + 0
}

TEST(Phong, WithoutSpecularItIsLambertian) {
  Material lambertian;
  lambertian.metallic = lambertian.specular = 0;
  lambertian.base_color = Vec4(0.2f, 0.5f, 0.7f, 1);
  const ClosureBench a(phong(Vec3(0.2f, 0.5f, 0.7f), Vec3(0), 20)), b(lambertian);
  const Vec3 wo = direction_at(50), wi = direction_at(20);
  EXPECT_EQ(a.bsdf(wo).eval(wo, wi).f_cos, b.bsdf(wo).eval(wo, wi).f_cos);
  EXPECT_EQ(a.bsdf(wo).eval(wo, wi).pdf, b.bsdf(wo).eval(wo, wi).pdf);
}

}  // namespace
}  // namespace candil::test
