// Light of spheres, discs and planes, known on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

const Vec3 albedo(0.2f, 0.5f, 0.8f), radiance(3, 2, 1);
const Mat3 upwards(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0));    // +z turned to +y
const Mat3 downwards(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));  // +z turned to -y

struct NamedIntegrator {
  const char* name;
  Integrator function;
  std::uint32_t samples;  // naive needs more to find a light
};

class ShapeClosedForm : public testing::TestWithParam<NamedIntegrator> {
 protected:
  /// A diffuse floor at y = 0, an infinite plane, and a ray to its origin from below all lights.
  ShapeClosedForm() { builder_.add_shape(ShapeKind::plane, {upwards, Vec3(0)}, builder_.add_diffuse(albedo)); }

  std::uint32_t add_emitter() {
    Material light;
    light.emission = radiance;
    light.base_color = Vec4(0, 0, 0, 1);
    light.metallic = 0, light.specular = 0;  // black to the last ray
    return builder_.add_material(light);
  }
  void expect(Vec3 expected) const {
    const Ray ray{Vec3(2, 0.5f, 0), glm::normalize(Vec3(-2, -0.5f, 0))};
    expect_radiance(estimate_radiance(Stage(builder_.scene), GetParam().function, ray, GetParam().samples), expected);
  }

  SceneBuilder builder_;
};

// The irradiance under a sphere of radius r whose centre is d away, at the cosine c to the normal, all of it above the
// horizon, is pi L c r^2 / d^2 (by the projected solid angle of a cone); a diffuse surface shows albedo / pi of it.
TEST_P(ShapeClosedForm, SphereLight) {
  builder_.add_shape(ShapeKind::sphere, {Mat3(0.9f), Vec3(0, 2, -1.5f)}, add_emitter());  // distance 2.5, cosine 0.8
  expect(albedo * radiance * 0.8f * 0.81f / 6.25f);
}

// On the axis of a disc of radius r at height h: pi L r^2 / (r^2 + h^2).
TEST_P(ShapeClosedForm, DiscLightOnItsAxis) {
  builder_.add_shape(ShapeKind::disc, {downwards * 0.8f, Vec3(0, 1.2f, 0)}, add_emitter());
  expect(albedo * radiance * 0.64f / (0.64f + 1.44f));
}

// Under an infinite plane every direction ends on it: pi L, whatever the height.
TEST_P(ShapeClosedForm, PlaneLightOverAPlane) {
  builder_.add_shape(ShapeKind::plane, {downwards, Vec3(3, 7, 1)}, add_emitter());
  expect(albedo * radiance);
}

// A plane at a right angle to the floor fills half of what the floor sees.
TEST_P(ShapeClosedForm, PlaneLightBesideAPlane) {
  const Mat3 sideways(Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 0, 0));  // +z turned to +x
  builder_.add_shape(ShapeKind::plane, {sideways, Vec3(-1, 0, 0)}, add_emitter());
  expect(0.5f * albedo * radiance);
}

// Two parallel planes, both diffuse and one shining: the floor's radiosity B = a (e + b B) for the lamp's albedo b.
TEST_P(ShapeClosedForm, PlanesLightEachOther) {
  const auto lamp = builder_.add_diffuse(Vec3(0.5f), radiance);
  builder_.add_shape(ShapeKind::plane, {downwards, Vec3(0, 3, 0)}, lamp);
  expect(albedo * radiance / (1.0f - 0.5f * albedo));
}

// Inside of a shining sphere, stretched or not, a surface without light of its own shows its albedo.
TEST_P(ShapeClosedForm, InsideOfAShiningEllipsoid) {
  const auto lamp = builder_.add_diffuse(Vec3(0), radiance);
  builder_.add_shape(ShapeKind::sphere, {Mat3(6, 0, 0, 1, 3, 0, 0, 0, 9), Vec3(0)}, lamp);
  expect(albedo * radiance);
}

INSTANTIATE_TEST_SUITE_P(Integrators, ShapeClosedForm,
                         testing::Values(NamedIntegrator{"path", trace_path, 60000},
                                         NamedIntegrator{"naive", trace_naive, 200000}),
                         [](const auto& test) { return test.param.name; });

Material glass() {
  Material m;
  m.metallic = 0, m.roughness = 0;
  m.transmission = 1, m.thickness = 1;
  return m;
}

// A glass ball in light from everywhere is invisible: what Fresnel and total reflection send one way, they take from
// the other. Rays start outside and, in the second case, inside of it.
TEST(ShapeGlass, BallInUniformLightIsInvisible) {
  SceneBuilder builder;
  builder.add_shape(ShapeKind::sphere, {Mat3(1, 0, 0, 0.3f, 0.6f, 0, 0, 0, 1.4f), Vec3(0)},
                    builder.add_material(glass()));
  builder.scene.environment.tint = Vec3(1);
  const Stage stage(builder.scene);
  const Ray ray{Vec3(0.3f, 2, 0.4f), glm::normalize(Vec3(-0.3f, -2, -0.4f))};
  for (const Integrator integrator : {trace_path, trace_naive}) {
    expect_radiance(estimate_radiance(stage, integrator, ray, 20000), Vec3(1));
  }
}

// Index 1 does not bend or reflect; c is left over after the attenuation distance of 0.5, so that a ray whose chord is
// 2 sqrt(1 - 0.6^2) = 1.6 long keeps c^3.2 (Beer-Lambert). Any step off the surface would show.
TEST(ShapeGlass, BallAttenuatesAlongItsChord) {
  SceneBuilder builder;
  Material m = glass();
  m.ior = 1, m.specular = 0;
  m.attenuation_color = Vec3(0.9f, 0.5f, 0.1f);
  m.attenuation_distance = 0.5f;
  builder.add_shape(ShapeKind::sphere, Affine{}, builder.add_material(m));
  builder.scene.environment.tint = Vec3(1);
  const Estimate seen = estimate_radiance(Stage(builder.scene), trace_path, {Vec3(0.6f, 3, 0), Vec3(0, -1, 0)}, 16);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen.mean[c], std::pow(m.attenuation_color[c], 3.2f), 1e-4f);
}

// Seen from its back a one-sided emitter is not there at all, like a triangle's.
TEST(ShapeSides, BacksOfOneSidedMaterialsAreInvisible) {
  SceneBuilder builder;
  Material lamp;
  lamp.emission = radiance;
  builder.add_shape(ShapeKind::plane, {downwards, Vec3(0, 1, 0)}, builder.add_material(lamp));
  builder.add_shape(ShapeKind::sphere, {Mat3(50), Vec3(0)}, builder.add_material(lamp));
  builder.scene.environment.tint = Vec3(0.25f);
  for (const Integrator integrator : {trace_path, trace_naive}) {
    const Estimate above = estimate_radiance(Stage(builder.scene), integrator, {Vec3(0, 2, 0), Vec3(0, -1, 0)}, 1);
    EXPECT_EQ(above.mean, Vec3(0.25f));
    const Estimate below = estimate_radiance(Stage(builder.scene), integrator, {Vec3(0), Vec3(0, 1, 0)}, 1, 0);
    EXPECT_EQ(below.mean, radiance);
  }
}

}  // namespace
}  // namespace candil::test
