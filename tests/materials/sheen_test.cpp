// Sheen beside the formulas of KHR_materials_sheen, written down again in double precision.
#include "materials/sheen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

double l(double x, double alpha) {
  const double t = (1 - alpha) * (1 - alpha);
  const auto mix = [t](double from, double to) { return from + (to - from) * t; };
  return mix(21.5473, 25.3245) / (1 + mix(3.82987, 3.32435) * std::pow(x, mix(0.19823, 0.16801))) +
         mix(-1.97760, -1.27393) * x + mix(-4.32054, -4.85967);
}

double lambda(double cosine, double alpha) {
  return std::exp(cosine < 0.5 ? l(cosine, alpha) : 2 * l(0.5, alpha) - l(1 - cosine, alpha));
}

struct Direction {
  double x, y, z;
};

/// f cos of white sheen.
double sheen(const Direction& o, const Direction& i, double roughness) {
  const double alpha = roughness * roughness;
  const double hx = o.x + i.x, hy = o.y + i.y, hz = o.z + i.z;
  const double cos2h = hz * hz / (hx * hx + hy * hy + hz * hz);
  const double distribution = (2 + 1 / alpha) * std::pow(1 - cos2h, 0.5 / alpha) / (2 * pi);
  const double visibility = 1 / ((1 + lambda(o.z, alpha) + lambda(i.z, alpha)) * 4 * o.z * i.z);
  return distribution * visibility * i.z;
}

/// Its albedo, by midpoints.
double albedo(double cosine, double roughness) {
  const Direction o{std::sqrt(1 - cosine * cosine), 0, cosine};
  constexpr int count = 200;
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    const double t = (k + 0.5) / count, z = t * t * t, sine = std::sqrt(1 - z * z);
    for (int j = 0; j < count; ++j) {
      const double phi = pi * (j + 0.5) / count;
      sum += sheen(o, {sine * std::cos(phi), sine * std::sin(phi), z}, roughness) * 3 * t * t;
    }
  }
  return sum * 2 * pi / (count * count);
}

Direction wide(Vec3 v) { return {v.x, v.y, v.z}; }

// Roughness and cosines off the table's points, and such that the model makes no energy.
TEST(Sheen, TableHoldsTheAlbedoOfTheFormulas) {
  const SheenAlbedo table;
  for (const float roughness : {0.07f, 0.08f, 0.123f, 0.31f, 0.53f, 0.77f, 1.0f}) {
    for (const float cosine : {0.002f, 0.011f, 0.083f, 0.27f, 0.61f, 0.93f}) {
      const double expected = albedo(cosine, roughness);
      EXPECT_NEAR(table.directional(roughness, cosine), expected, 4e-3 * std::max(1.0, expected))
          << "roughness " << roughness << ", cosine " << cosine;
    }
  }
}

TEST(Sheen, FollowsTheFormulas) {
  const SheenAlbedo table;
  const Vec3 color(0.9f, 0.4f, 0.1f);
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    for (const float angle : {10.0f, 50.0f, 80.0f}) {
      const Vec3 wo = direction_at(angle), wi = direction_at(65);
      const SheenLobe lobe({color, roughness}, table, Vec3(0, 0, 1), wo);
      const double expected = sheen(wide(wo), wide(wi), roughness);
      const Vec3 value = lobe.eval(wo, wi).f_cos;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], color[c] * expected, 1e-3 * color[c] * expected + 1e-7);
    }
  }
}

// Where the model would return more than it gets, as at a cosine of 0.01 for a roughness of 0.1 (1.92 times as much),
// it returns everything.
TEST(Sheen, MakesNoEnergy) {
  const SheenAlbedo table;
  ASSERT_GT(table.directional(0.1f, 0.01f), 1.9f);
  const SheenLobe lobe({Vec3(1), 0.1f}, table, Vec3(0, 0, 1), glm::normalize(Vec3(1, 0, 0.01f)));
  EXPECT_EQ(lobe.albedo(), Vec3(1));
  EXPECT_EQ(lobe.taken(), 1);
}

/// Energy that leaves for radiance 1 from everywhere, of a closure without mirrors, by midpoints that are close to each
/// other at grazing angles. None of it refracts.
Vec3 energy(const Bsdf& bsdf, Vec3 wo) {
  constexpr int rows = 96, columns = 64;
  Vec3 sum(0);
  for (int i = 0; i < rows; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / rows, z = t * t * t, sine = std::sqrt(1 - z * z);
    for (int j = 0; j < columns; ++j) {
      const float phi = 2 * pi * (static_cast<float>(j) + 0.5f) / columns;
      const Vec3 wi(sine * std::cos(phi), sine * std::sin(phi), z);
      sum += (bsdf.eval(wo, wi).f_cos + bsdf.eval(wo, Vec3(wi.x, wi.y, -wi.z)).f_cos) * (3 * t * t);
    }
  }
  return sum * (2 * pi / (rows * columns));
}

Material white(float roughness) {
  Material m;
  m.metallic = 0, m.roughness = roughness;
  m.extensions.emplace();
  return m;
}

// On everything that is white and not too glossy to be integrated, below a coat, and letting light through.
TEST(Sheen, KeepsAllEnergyOfWhite) {
  Material diffuse = white(1), plastic = white(0.6f), metal = white(0.6f), translucent = white(0.6f), coated = white(1);
  diffuse.specular = 0;
  metal.metallic = 1;
  translucent.extensions->diffuse_transmission = 0.5f;
  coated.extensions->clearcoat = 1, coated.extensions->clearcoat_roughness = 0.6f;
  coated.extensions->diffuse_transmission = 0.3f;
  for (Material material : {diffuse, plastic, metal, translucent, coated}) {
    for (const float roughness : {0.0f, 0.09f, 0.14f, 0.3f, 0.62f, 1.0f}) {
      for (const Vec3 color : {Vec3(1), Vec3(0.4f)}) {
        material.extensions->sheen_color = color, material.extensions->sheen_roughness = roughness;
        const ClosureBench bench(material);
        for (const float angle : {0.0f, 50.0f, 75.0f, 83.0f, 87.0f, 89.5f, 91.0f, 100.0f}) {
          if (angle > 90 && !material.is_transmissive()) continue;
          const Vec3 wo = direction_at(angle), all = energy(bench.bsdf(wo), wo);
          EXPECT_GT(min_component(all), 0.99f) << roughness << " at " << angle;
          EXPECT_LT(max_component(all), 1.005f) << roughness << " at " << angle;
        }
      }
    }
  }
}

}  // namespace
}  // namespace candil::test
