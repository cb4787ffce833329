// Scenes whose radiance is known on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

const Ray down_to_origin{Vec3(0.3f, 2, 0.4f), glm::normalize(Vec3(-0.3f, -2, -0.4f))};

Material lossless_plastic(float roughness) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.is_double_sided = true;
  return m;
}

struct NamedIntegrator {
  const char* name;
  Integrator function;
};

class ClosedForm : public testing::TestWithParam<NamedIntegrator> {};

// A closed box whose walls emit e and reflect a, diffusely: every bounce adds e a^k, so radiance is e / (1 - a)
// everywhere.
TEST_P(ClosedForm, FurnaceBoxIsAGeometricSeries) {
  for (const auto& [albedo, expected] : {std::pair(0.5f, 2.0f), std::pair(0.8f, 5.0f)}) {
    SceneBuilder builder;
    builder.add_cube(Vec3(0, 1, 0), 4, builder.add_diffuse(Vec3(albedo), Vec3(1)), true);
    expect_radiance(estimate_radiance(Stage(builder.scene), GetParam().function, down_to_origin, 40000),
                    Vec3(expected));
  }
}

// Inside a black sphere of radiance 1, whatever loses no light shows radiance 1, and a diffuse albedo shows itself.
TEST_P(ClosedForm, UniformSphereShowsTheAlbedo) {
  SceneBuilder builder;
  builder.add_sphere(Vec3(0), 10, builder.add_diffuse(Vec3(0), Vec3(1)));
  builder.add_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_diffuse(Vec3(0.2f, 0.5f, 0.9f)));
  expect_radiance(estimate_radiance(Stage(builder.scene), GetParam().function, down_to_origin, 20000),
                  Vec3(0.2f, 0.5f, 0.9f));
}

// The same with lossless closures, whose albedo tables are good to 0.5 %.
TEST_P(ClosedForm, UniformSphereHidesLosslessSurfaces) {
  for (const float roughness : {0.0f, 0.2f, 0.6f, 1.0f}) {
    for (const float metallic : {0.0f, 1.0f}) {
      SceneBuilder builder;
      Material m = lossless_plastic(roughness);
      m.metallic = metallic;
      builder.add_sphere(Vec3(0), 10, builder.add_diffuse(Vec3(0), Vec3(1)));
      builder.add_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_material(m));
      const Estimate e = estimate_radiance(Stage(builder.scene), GetParam().function, down_to_origin, 20000);
      EXPECT_NEAR(e.mean.x, 1, 0.005f + 6 * e.standard_error.x)
          << "roughness " << roughness << " metallic " << metallic;
      EXPECT_LT(e.standard_error.x, 0.01f);
    }
  }
}

// A glass ball in light from everywhere is invisible: what Fresnel and total reflection send one way, they take from
// the other.
TEST_P(ClosedForm, GlassBallInUniformLightIsInvisible) {
  SceneBuilder builder;
  Material glass = lossless_plastic(0);
  glass.transmission = 1, glass.thickness = 1, glass.is_double_sided = false;
  builder.add_sphere(Vec3(0), 1, builder.add_material(glass));
  builder.scene.environment.tint = Vec3(1);
  expect_radiance(estimate_radiance(Stage(builder.scene), GetParam().function, down_to_origin, 20000), Vec3(1));
}

// A slab of thickness 1 and index 1 (no reflection) that leaves c over after its attenuation distance of 0.5: seen
// straight through, c^2 of the radiance behind it arrives (Beer-Lambert).
TEST_P(ClosedForm, VolumeAttenuatesByBeerLambert) {
  SceneBuilder builder;
  Material m = lossless_plastic(0);
  m.transmission = 1, m.thickness = 1, m.is_double_sided = false;
  m.ior = 1;
  m.specular = 0;
  m.attenuation_color = Vec3(0.9f, 0.5f, 0.1f);
  m.attenuation_distance = 0.5f;
  builder.add_cube(Vec3(0), 0.5f, builder.add_material(m), false);
  builder.scene.environment.tint = Vec3(1);
  const Ray ray{Vec3(0.1f, 2, 0.2f), Vec3(0, -1, 0)};
  expect_radiance(estimate_radiance(Stage(builder.scene), GetParam().function, ray, 64), Vec3(0.81f, 0.25f, 0.01f));
}

// A square light of half side a, h above a diffuse plane: the point under its centre sees the configuration factor
// F = 4 / (2 pi) * 2 * A / sqrt(1 + A^2) * atan(A / sqrt(1 + A^2)), A = a / h (Howell, factor B-3), and shows albedo L
// F.
TEST_P(ClosedForm, SquareLightOverAPlane) {
  SceneBuilder builder;
  const float half = 1, height = 2, ratio = half / height;
  Material light;
  light.emission = Vec3(3, 2, 1);
  light.base_color = Vec4(0, 0, 0, 1);
  light.specular = 0;
  const auto light_id = builder.add_material(light);
  builder.add_quad(Vec3(-half, height, -half), Vec3(2 * half, 0, 0), Vec3(0, 0, 2 * half), light_id);  // faces down
  builder.add_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18), builder.add_diffuse(Vec3(0.6f)));
  const float root = std::sqrt(1 + ratio * ratio);
  const float factor = 4 / pi * ratio / root * std::atan(ratio / root);
  const Ray ray{Vec3(2, 1, 0), glm::normalize(Vec3(-2, -1, 0))};
  expect_radiance(estimate_radiance(Stage(builder.scene), GetParam().function, ray, 200000),
                  0.6f * factor * Vec3(3, 2, 1));
}

INSTANTIATE_TEST_SUITE_P(Integrators, ClosedForm,
                         testing::Values(NamedIntegrator{"path", trace_path}, NamedIntegrator{"naive", trace_naive}),
                         [](const auto& test) { return test.param.name; });

// Lights without a size leave no noise: albedo / pi times the irradiance, exactly.
class PunctualClosedForm : public testing::Test {
 protected:
  static Vec3 radiance_under(const PunctualLight& light) {
    SceneBuilder builder;
    builder.add_quad(Vec3(-9, 0, 9), Vec3(18, 0, 0), Vec3(0, 0, -18), builder.add_diffuse(Vec3(0.5f)));
    builder.scene.punctual_lights = {light};
    const Estimate e = estimate_radiance(Stage(builder.scene), trace_path, down_to_origin, 4);
    EXPECT_LT(max_component(e.standard_error), 1e-6f);
    return e.mean;
  }
};

TEST_F(PunctualClosedForm, PointLightFallsWithDistanceAndCosine) {
  PunctualLight light;
  light.intensity = Vec3(40, 20, 10);
  light.position = Vec3(3, 4, 0);  // distance 5, cosine 4/5
  EXPECT_NEAR(radiance_under(light).x, 0.5f / pi * 40 * 0.8f / 25, 1e-5f);
}

// The window function of KHR_lights_punctual: (1 - (d / range)^4); at 5 of 10 metres it is 15/16.
TEST_F(PunctualClosedForm, RangeFadesTheLight) {
  PunctualLight light;
  light.intensity = Vec3(40);
  light.position = Vec3(3, 4, 0);
  light.range = 10;
  EXPECT_NEAR(radiance_under(light).x, 0.5f / pi * 40 * 0.8f / 25 * 15 / 16, 1e-5f);
  light.range = 4.9f;
  EXPECT_EQ(radiance_under(light).x, 0);
}

// KHR_lights_punctual: between the cones the factor is ((cos(angle) - cos(outer)) / (cos(inner) - cos(outer)))^2.
TEST_F(PunctualClosedForm, SpotFadesBetweenItsCones) {
  PunctualLight light;
  light.kind = PunctualKind::spot;
  light.intensity = Vec3(8);
  light.position = Vec3(0, 2, 0);
  light.inner_cone = 0.2f;
  light.outer_cone = 0.5f;
  const auto at_angle = [&](float angle) {
    light.direction = Vec3(std::sin(angle), -std::cos(angle), 0);
    return radiance_under(light).x;
  };
  EXPECT_NEAR(at_angle(0.1f), 0.5f / pi * 8 / 4, 1e-5f);
  const float factor = (std::cos(0.3f) - std::cos(0.5f)) / (std::cos(0.2f) - std::cos(0.5f));
  EXPECT_NEAR(at_angle(0.3f), 0.5f / pi * 8 / 4 * factor * factor, 1e-5f);
  EXPECT_EQ(at_angle(0.51f), 0);
}

TEST_F(PunctualClosedForm, DirectionalLightIsLux) {
  PunctualLight light;
  light.kind = PunctualKind::directional;
  light.intensity = Vec3(3);
  light.direction = glm::normalize(Vec3(1, -1, 0));
  EXPECT_NEAR(radiance_under(light).x, 0.5f / pi * 3 * std::sqrt(0.5f), 1e-5f);
}

}  // namespace
}  // namespace candil::test
