// What holds for every closure, whatever its formula: reciprocity, agreement of sample() with eval(), energy.
#include "materials/bsdf.h"

#include <gtest/gtest.h>

#include "core/sampler.h"
#include "core/warp.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

constexpr float angles[] = {0, 40, 75, 140, 105};  // degrees; beyond 90 from behind

struct Random {
  std::uint32_t index;
  Sampler sampler() const { return Sampler({3, 5}, index, 11); }
};

bool sees_back(const Material& m, float angle) { return angle <= 90 || m.is_transmissive(); }

TEST(Bsdf, WeightTimesPdfIsWhatEvalSays) {
  const std::vector<NamedMaterial> all = rough_materials();
  const ClosureBench bench(all);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const NamedMaterial& named = all[m];
    for (const float angle : angles) {
      if (!sees_back(named.material, angle)) continue;
      const Vec3 wo = direction_at(angle);
      const Bsdf bsdf = bench.bsdf_of(m, wo);
      for (std::uint32_t i = 0; i < 200; ++i) {
        const Sampler s = Random{i}.sampler();
        const auto sample = bsdf.sample(wo, s.sample_2d(0).x, s.sample_2d(1));
        if (!sample || sample->is_delta) continue;
        const BsdfEval value = bsdf.eval(wo, sample->wi);
        ASSERT_NEAR(value.pdf, sample->pdf, 2e-3f * sample->pdf) << named.name << " at " << angle;
        const Vec3 f_cos = sample->weight * sample->pdf;
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(value.f_cos[c], f_cos[c], 2e-3f * f_cos[c] + 1e-6f) << named.name << " at " << angle;
        }
      }
    }
  }
}

// Veach 1997, section 5.2: f(wo, wi) / n_o^2 = f(wi, wo) / n_i^2 with n the index on the side of the first argument.
// (f is for radiance: it holds (n_o / n_i)^2 when light crosses from wi's side to wo's.)
TEST(Bsdf, IsReciprocal) {
  const std::vector<NamedMaterial> all = rough_materials();
  const ClosureBench bench(all);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const NamedMaterial& named = all[m];
    if (!named.is_reciprocal) continue;
    const bool refracts = named.material.is_volume() && named.material.transmission > 0 && named.material.ior > 0;
    const auto index = [&](Vec3 w) { return w.z < 0 && refracts ? named.material.ior : 1.0f; };
    int compared = 0;
    for (std::uint32_t i = 0; i < 500; ++i) {
      const Sampler s = Random{i}.sampler();
      Vec3 a = sample_sphere(s.sample_2d(0)), b = sample_sphere(s.sample_2d(1));
      if (!named.material.is_transmissive()) a.z = std::abs(a.z), b.z = std::abs(b.z);
      if (std::abs(a.z) < 0.02f || std::abs(b.z) < 0.02f) continue;
      const Vec3 forward = bench.bsdf_of(m, a).eval(a, b).f_cos / (std::abs(b.z) * sqr(index(a)));
      const Vec3 backward = bench.bsdf_of(m, b).eval(b, a).f_cos / (std::abs(a.z) * sqr(index(b)));
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(forward[c], backward[c], 5e-3f * (forward[c] + backward[c]) + 1e-5f)
            << named.name << " a.z " << a.z << " b.z " << b.z;
      }
      compared += forward.x > 0;
    }
    EXPECT_GT(compared, 50) << named.name;
  }
}

/// Layers, anisotropy, films, and the other extensions: the tables behind their energy are fine enough for grazing
/// angles.
bool has_exact_energy(const Material& m) { return has_extended_facets(m); }

/// Its film of strong colours is sampled by brightness, and each channel is noisier than that.
bool is_noisy(const NamedMaterial& named) { return named.name.starts_with("soap_sheet"); }

/// Plain facets choose the light of multiple scattering by the cosine: where little is lost, it is found rarely.
constexpr std::uint32_t plain_samples = 131072;

constexpr float least_kept = 0.99f, most_kept = 1.005f;

/// Of material m, which is `named`.
Vec3 furnace_at(const ClosureBench& bench, std::size_t m, const NamedMaterial& named, float angle) {
  const Vec3 wo = direction_at(angle);
  const bool is_plain = !has_exact_energy(named.material) && named.material.roughness > 0;
  return furnace(bench.bsdf_of(m, wo), wo,
                 is_plain          ? plain_samples
                 : is_noisy(named) ? 65536
                                   : 4096,
                 named.is_lossless ? least_kept : 0.0f, most_kept);
}

// Lossless closures under light from everywhere return exactly what they get (white furnace). The albedo tables are
// interpolated, and the samples are few: 1 % covers both, and what is gained is half of that.
TEST(Bsdf, LosslessClosuresKeepAllEnergy) {
  std::vector<NamedMaterial> all = rough_materials();
  for (const NamedMaterial& m : smooth_materials()) all.push_back(m);
  for (const float roughness : {0.1f, 0.8f}) {  // between the points of the tables
    for (NamedMaterial m : materials_of_roughness(roughness)) {
      m.name += " " + std::to_string(roughness);
      all.push_back(m);
    }
  }
  const ClosureBench bench(all);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const NamedMaterial& named = all[m];
    if (!named.is_lossless) continue;
    for (const float angle : angles) {
      if (!sees_back(named.material, angle)) continue;
      const Vec3 energy = furnace_at(bench, m, named, angle);
      for (int c = 0; c < 3; ++c) {
        EXPECT_GT(energy[c], least_kept) << named.name << " at " << angle;
        EXPECT_LT(energy[c], most_kept) << named.name << " at " << angle;
      }
    }
  }
}

TEST(Bsdf, LosslessLayersKeepAllEnergyAtGrazingAngles) {
  for (const float roughness : {0.0f, 0.05f, 0.13f, 0.4f, 0.9f, 1.0f}) {
    const std::vector<NamedMaterial> all = materials_of_roughness(roughness);
    const ClosureBench bench(all);
    for (std::size_t m = 0; m < all.size(); ++m) {
      const NamedMaterial& named = all[m];
      if (!named.is_lossless || !has_exact_energy(named.material)) continue;
      for (const float angle : {85.0f, 88.0f, 89.5f, 90.5f, 92.0f, 95.0f}) {
        if (!sees_back(named.material, angle)) continue;
        const Vec3 energy = furnace_at(bench, m, named, angle);
        for (int c = 0; c < 3; ++c) {
          EXPECT_GT(energy[c], least_kept) << named.name << " " << roughness << " at " << angle;
          EXPECT_LT(energy[c], most_kept) << named.name << " " << roughness << " at " << angle;
        }
      }
    }
  }
}

TEST(Bsdf, LosslessPlainClosuresKeepAllEnergyAtGrazingAngles) {
  for (const float roughness : {0.08f, 0.13f, 0.4f}) {
    std::vector<NamedMaterial> all = materials_of_roughness(roughness);
    std::erase_if(all, [](const NamedMaterial& m) { return !m.is_lossless || has_exact_energy(m.material); });
    const ClosureBench bench(all);
    for (std::size_t m = 0; m < all.size(); ++m) {
      for (const float angle : {88.0f, 89.5f, 90.5f, 92.0f}) {
        if (!sees_back(all[m].material, angle)) continue;
        const Vec3 energy = furnace_at(bench, m, all[m], angle);
        for (int c = 0; c < 3; ++c) {
          EXPECT_GT(energy[c], least_kept) << all[m].name << " " << roughness << " at " << angle;
          EXPECT_LT(energy[c], most_kept) << all[m].name << " " << roughness << " at " << angle;
        }
      }
    }
  }
}

TEST(Bsdf, NoClosureGainsEnergy) {
  std::vector<NamedMaterial> all = rough_materials();
  for (const NamedMaterial& m : smooth_materials()) all.push_back(m);
  const ClosureBench bench(all);
  for (std::size_t m = 0; m < all.size(); ++m) {
    const NamedMaterial& named = all[m];
    for (const float angle : {0.0f, 30.0f, 60.0f, 85.0f, 89.0f, 91.0f, 120.0f, 180.0f}) {
      if (!sees_back(named.material, angle)) continue;
      const Vec3 energy = furnace_at(bench, m, named, angle);
      EXPECT_LT(max_component(energy), most_kept) << named.name << " at " << angle;
      EXPECT_GT(max_component(energy), 0.05f) << named.name << " at " << angle;
    }
  }
}

// Snell's law and exact Fresnel reflectance at a smooth interface: at 30 degrees from air into 1.5 the refracted sine
// is 1/3.
TEST(Bsdf, SmoothGlassObeysSnellAndFresnel) {
  Material m;
  m.metallic = 0, m.roughness = 0, m.transmission = 1, m.thickness = 1;
  const ClosureBench bench(m);
  const Vec3 wo = direction_at(30);
  const Bsdf bsdf = bench.bsdf(wo);
  EXPECT_TRUE(bsdf.is_purely_delta());
  const auto transmitted = bsdf.sample(wo, 0.99f, Vec2(0.5f));
  ASSERT_TRUE(transmitted && transmitted->is_transmission && transmitted->is_delta);
  EXPECT_NEAR(std::hypot(transmitted->wi.x, transmitted->wi.y), 1 / 3.0f, 1e-6f);
  EXPECT_LT(transmitted->wi.z, 0);
  EXPECT_FLOAT_EQ(transmitted->eta, 1.5f);
  // cos_t = sqrt(8)/3; r_s = ((cos 30 - 1.5 cos_t) / (cos 30 + 1.5 cos_t))^2 = 0.05780, r_p = 0.02525; mean 0.04152.
  EXPECT_NEAR(1 - transmitted->pdf, 0.04152f, 2e-5f);
  EXPECT_NEAR(transmitted->weight.x, 1 / 2.25f, 1e-5f);
}

TEST(Bsdf, TotalInternalReflectionReflectsEverything) {
  Material m;
  m.metallic = 0, m.roughness = 0, m.transmission = 1, m.thickness = 1;
  const ClosureBench bench(m);
  const Vec3 wo = direction_at(180 - 45);  // beyond the critical angle of 41.8 degrees
  const auto sample = bench.bsdf(wo).sample(wo, 0.999f, Vec2(0.5f));
  ASSERT_TRUE(sample);
  EXPECT_FALSE(sample->is_transmission);
  EXPECT_NEAR(sample->weight.x, 1, 1e-6f);
  EXPECT_NEAR(sample->wi.z, wo.z, 1e-6f);
}

// A diffuse surface without specular is the plain Lambertian: f = base / pi.
TEST(Bsdf, ZeroSpecularIsLambertian) {
  Material m;
  m.metallic = 0, m.specular = 0;
  m.base_color = Vec4(0.25f, 0.5f, 0.75f, 1);
  const ClosureBench bench(m);
  const Vec3 wo = direction_at(50), wi = direction_at(20);
  const BsdfEval value = bench.bsdf(wo).eval(wo, wi);
  EXPECT_NEAR(value.f_cos.y, 0.5f / pi * wi.z, 1e-6f);
  EXPECT_NEAR(value.pdf, wi.z / pi, 1e-6f);
}

}  // namespace
}  // namespace candil::test
