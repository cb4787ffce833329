// Which lights are chosen, and which of their sides shine.
#include "core/light_sampler.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/chi_square.h"
#include "tests/support/light_scenes.h"

namespace candil::test {
namespace {

// Behind a one-sided light there is none of it; behind a two-sided one there is.
TEST(LightSampler, BackSidesShineOnlyIfDoubleSided) {
  for (const bool is_double_sided : {false, true}) {
    SceneBuilder builder;
    Material material = emitter(Vec3(1));
    material.is_double_sided = is_double_sided;
    builder.add_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_material(material));  // faces up
    const LightSampler lights(builder.scene);
    Random random(4);
    int above = 0, below = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = random.next_2d();
      const float pick = random.next_1d();
      above += lights.sample(point_at(Vec3(0, 2, 0)), pick, u).has_value();
      below += lights.sample(point_at(Vec3(0, -2, 0)), pick, u).has_value();
    }
    EXPECT_EQ(above, 1000);
    EXPECT_EQ(below, is_double_sided ? 1000 : 0);
  }
}

// Lights are picked in proportion to their power: pi area L per side of an emitter, 4 pi I of a point light.
TEST(LightSampler, FrequenciesArePowerShares) {
  SceneBuilder builder;
  builder.add_quad(Vec3(-1, 5, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(emitter(Vec3(3))));  // 4 m2
  builder.add_quad(Vec3(-4, 5, -1), Vec3(1, 0, 0), Vec3(0, 0, 1), builder.add_diffuse(Vec3(0), Vec3(7)));   // two sides
  PunctualLight lamp;
  lamp.position = Vec3(3, 1, 0);
  lamp.intensity = Vec3(2);
  builder.scene.punctual_lights = {lamp};
  const LightSampler lights(builder.scene);
  ASSERT_EQ(lights.light_count(), 5u);
  const double one_sided = pi * 4 * 3, two_sided = 2 * pi * 1 * 7, point = 4 * pi * 2;
  const double total = one_sided + two_sided + point;
  constexpr int n = 100000;
  std::array<double, 3> observed{};
  Random random(5);
  for (int i = 0; i < n; ++i) {
    const float pick = random.next_1d();
    const std::optional<LightSample> sample = lights.sample(point_at(Vec3(0)), pick, random.next_2d());
    ASSERT_TRUE(sample);
    ++observed[sample->is_delta ? 2 : sample->radiance.x > 5 ? 1 : 0];
    if (sample->is_delta) {
      EXPECT_NEAR(sample->pdf, point / total, 1e-5);
    }
  }
  const std::array expected = {n * one_sided / total, n * two_sided / total, n * point / total};
  EXPECT_GT(chi_square_test(observed, expected).p_value, significance);
}

TEST(LightSampler, WithoutLightsIsEmpty) {
  SceneBuilder builder;
  builder.add_quad(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), builder.add_diffuse(Vec3(1)));
  const LightSampler lights(builder.scene);
  EXPECT_TRUE(lights.is_empty());
  EXPECT_EQ(lights.pdf_hit(Vec3(0, 0, 1), make_surface_point(builder.scene, Hit{})), 0);
  EXPECT_EQ(lights.pdf_miss(Vec3(0, 1, 0)), 0);
}

}  // namespace
}  // namespace candil::test
