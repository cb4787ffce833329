// `classic`, the report's estimator, has the expected value of `path` wherever emitters reflect nothing.
#include <gtest/gtest.h>

#include "tests/integrators/mean_comparison.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

struct NamedScene {
  const char* name;
  void (*build)(SceneBuilder&);
};

std::uint32_t add_emitter(SceneBuilder& builder, Vec3 radiance) { return builder.add_diffuse(Vec3(0), radiance); }

std::uint32_t add_phong(SceneBuilder& builder, Vec3 kd, Vec3 ks, float exponent) {
  Material m;
  m.model = MaterialModel::phong;
  m.base_color = Vec4(kd, 1);
  m.specular_color = ks;
  m.phong_exponent = exponent;
  m.is_double_sided = true;
  return builder.add_material(m);
}

std::uint32_t add_glass(SceneBuilder& builder, float ior, float roughness) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.transmission = m.thickness = 1;
  m.ior = ior;
  m.attenuation_color = Vec3(0.9f, 0.7f, 0.5f);
  m.attenuation_distance = 2;
  return builder.add_material(m);
}

void add_point_light(SceneBuilder& builder, Vec3 position, Vec3 intensity) {
  PunctualLight light;
  light.position = position;
  light.intensity = intensity;
  builder.scene.punctual_lights.push_back(light);
}

void add_box(SceneBuilder& builder) { builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.7f, 0.5f, 0.4f)), true); }

void add_ceiling_light(SceneBuilder& builder, Vec3 radiance) {
  builder.add_quad(Vec3(-2, 2.5f, -2), Vec3(4, 0, 0), Vec3(0, 0, 4), add_emitter(builder, radiance));
}

void diffuse_box_with_area_light(SceneBuilder& builder) {
  add_box(builder);
  add_ceiling_light(builder, Vec3(3, 4, 5));
  builder.add_sphere(Vec3(-0.8f, -0.5f, 0), 0.8f, builder.add_diffuse(Vec3(0.8f, 0.3f, 0.1f)), 8);
}

void mirror_plastic_and_phong_with_point_lights(SceneBuilder& builder) {
  add_box(builder);
  add_point_light(builder, Vec3(-2, 2, 1), Vec3(20, 18, 16));
  add_point_light(builder, Vec3(2, 1, 2), Vec3(4, 4, 8));
  builder.add_sphere(Vec3(-1.1f, 0, 0), 0.6f, add_phong(builder, Vec3(0), Vec3(0.9f, 0.9f, 0.8f), infinity), 12);
  builder.add_sphere(Vec3(0.2f, 0, 0), 0.6f, add_phong(builder, Vec3(0.5f, 0.2f, 0.1f), Vec3(0.3f), infinity), 12);
  builder.add_sphere(Vec3(1.5f, 0, 0), 0.6f, add_phong(builder, Vec3(0.2f, 0.5f, 0.2f), Vec3(0.4f), 20), 12);
}

void glass_under_the_sky(SceneBuilder& builder) {
  builder.scene.environment.tint = Vec3(0.7f, 0.8f, 1);
  builder.add_quad(Vec3(-3, -1, 3), Vec3(6, 0, 0), Vec3(0, 0, -6), builder.add_diffuse(Vec3(0.6f, 0.5f, 0.4f)));
  builder.add_sphere(Vec3(-0.9f, 0, 0), 0.8f, add_glass(builder, 1.5f, 0), 16);
  builder.add_sphere(Vec3(0.9f, 0, 0.2f), 0.8f, add_glass(builder, 2.42f, 0.4f), 16);
}

void metals_and_gltf_under_all_lights(SceneBuilder& builder) {
  builder.scene.environment.tint = Vec3(0.4f, 0.5f, 0.6f);
  add_point_light(builder, Vec3(-2, 2, 2), Vec3(6));
  add_ceiling_light(builder, Vec3(2));
  Material plastic;
  plastic.metallic = 0.3f;
  plastic.roughness = 0.4f;
  plastic.base_color = Vec4(0.2f, 0.4f, 0.7f, 1);
  plastic.is_double_sided = true;
  builder.add_quad(Vec3(-3, -1, 3), Vec3(6, 0, 0), Vec3(0, 0, -6), builder.add_material(plastic));
  Material metal;
  metal.model = MaterialModel::conductor;
  metal.roughness = 0.5f;
  builder.add_sphere(Vec3(-0.9f, 0, 0), 0.8f, builder.add_material(metal), 12);
  Material sheet = plastic;
  sheet.transmission = 0.6f;
  builder.add_quad(Vec3(0.2f, -0.8f, 1), Vec3(1.4f, 0, 0), Vec3(0, 1.6f, 0), builder.add_material(sheet));
}

const NamedScene scenes[] = {{"diffuse_box_with_area_light", diffuse_box_with_area_light},
                             {"mirror_plastic_and_phong_with_point_lights", mirror_plastic_and_phong_with_point_lights},
                             {"glass_under_the_sky", glass_under_the_sky},
                             {"metals_and_gltf_under_all_lights", metals_and_gltf_under_all_lights}};

class Classic : public testing::TestWithParam<NamedScene> {};

TEST_P(Classic, HasTheMeanOfPath) {
  SceneBuilder builder;
  GetParam().build(builder);
  const Stage stage(builder.scene);
  expect_same_mean(stage, IntegratorKind::path, IntegratorKind::classic, 0.005f);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Classic, testing::ValuesIn(scenes), [](const auto& test) { return test.param.name; });

// A point light over a diffuse plane, one bounce: albedo / pi I cos / r^2. At height 2 straight above the point: 4 / pi
// x 0.5 / 4 = 0.159155. Shadow rays are shot by the paths that are not absorbed alone: half of them.
TEST(ClassicEstimator, AbsorbsBeforeItAsksTheLights) {
  SceneBuilder builder;
  builder.add_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_diffuse(Vec3(0.5f)));
  add_point_light(builder, Vec3(0, 2, 0), Vec3(4));
  const Stage stage(builder.scene);
  const Ray ray{Vec3(0, 1, 1), glm::normalize(Vec3(0, -1, -1))};
  expect_radiance(estimate_radiance(stage, trace_classic, ray, 40000), Vec3(0.159155f));
  RayCounts rays;
  for (std::uint32_t i = 0; i < 4096; ++i) trace_classic(stage.context(), {}, ray, Sampler({1, 2}, i, 3), rays);
  EXPECT_NEAR(static_cast<double>(rays.shadow), 2048, 64);
}

// Paths end at emitters, which reflect nothing: a furnace box of radiance 1 shows 1, not 1 / (1 - a).
TEST(ClassicEstimator, EndsAtEmitters) {
  SceneBuilder builder;
  builder.add_cube(Vec3(0), 1, builder.add_diffuse(Vec3(0.8f), Vec3(1)), true);
  const Estimate e = estimate_radiance(Stage(builder.scene), trace_classic, {Vec3(0), Vec3(0, 0, -1)}, 100);
  EXPECT_EQ(e.mean.x, 1);
}

}  // namespace
}  // namespace candil::test
