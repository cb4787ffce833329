// KHR_materials_diffuse_transmission: what arrives from the other side of a sheet, and of the skin of a volume.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// A triangle in the plane z = 0 with its front towards +z; no coat, so that the diffuse base is all there is. Lights
/// without a size leave no noise.
Scene triangle(const std::string& transmission, const std::string& more = "") {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {R"({"pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.8,1],"metallicFactor":0},"extensions":{
      "KHR_materials_specular":{"specularFactor":0},"KHR_materials_diffuse_transmission":{)" +
                      transmission + "}" + more + "}}"};
  sample.root = R"(,"extensionsUsed":["KHR_materials_diffuse_transmission"],
                    "extensionsRequired":["KHR_materials_diffuse_transmission"])";
  return load_sample(sample).scene;
}

/// Seen from above or below, at (0.3, 0.3, 0).
Vec3 radiance(const Scene& scene, float eye_z) {
  const Vec3 eye(0.3f, 0.3f, eye_z);
  return estimate_radiance(Stage(scene), trace_path, {eye, Vec3(0, 0, eye_z > 0 ? -1 : 1)}, 64).mean;
}

PunctualLight lamp(Vec3 position, float intensity) {
  PunctualLight light;
  light.position = position;
  light.intensity = Vec3(intensity);
  return light;
}

void expect_near(Vec3 value, Vec3 expected) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], 1e-5f + 1e-4f * expected[c]) << "channel " << c;
}

// A lamp of 20 candela 2 metres above the point, seen from the other side and from its own: share x color / pi and
// (1 - share) x base / pi times 20 / 2^2. Back faces of the single-sided material are there.
TEST(GltfDiffuseTransmission, ShinesThroughASheet) {
  for (const float side : {1.0f, -1.0f}) {
    Scene scene = triangle(R"("diffuseTransmissionFactor":0.25,"diffuseTransmissionColorFactor":[1,0.5,0.1])");
    scene.punctual_lights = {lamp(Vec3(0.3f, 0.3f, 2 * side), 20)};
    expect_near(radiance(scene, -side), 0.25f * Vec3(1, 0.5f, 0.1f) * (5 / pi));
    expect_near(radiance(scene, side), 0.75f * Vec3(0.2f, 0.4f, 0.8f) * (5 / pi));
  }
}

// With a thickness, what shines through has come through the volume: Beer and Lambert's law over 2 metres, of which
// 0.5 leave (0.9, 0.5, 1) of white, so 2 leave the fourth power.
TEST(GltfDiffuseTransmission, EntersAVolume) {
  Scene scene = triangle(R"("diffuseTransmissionFactor":1)", R"(,"KHR_materials_volume":{"thicknessFactor":1,
      "attenuationDistance":0.5,"attenuationColor":[0.9,0.5,1]})");
  scene.punctual_lights = {lamp(Vec3(0.3f, 0.3f, -2), 20)};
  expect_near(radiance(scene, 1), Vec3(std::pow(0.9f, 4.0f), std::pow(0.5f, 4.0f), 1) * (5 / pi));
  // From inside, the lamp outside is not attenuated; the 1 metre to the eye is not either, which the path does not
  // know to be inside.
  scene.punctual_lights = {lamp(Vec3(0.3f, 0.3f, 2), 20)};
  expect_near(radiance(scene, -1), Vec3(5 / pi));
}

TEST(GltfDiffuseTransmission, FactorZeroEqualsNone) {
  Scene with = triangle(R"("diffuseTransmissionFactor":0,"diffuseTransmissionColorFactor":[1,0,0])");
  Scene without = with;
  without.materials[0].extensions.reset();
  with.materials[0].extensions.emplace().diffuse_transmission_color = Vec3(1, 0, 0);
  for (Scene* scene : {&with, &without}) scene->punctual_lights = {lamp(Vec3(0, 0, 2), 20)};
  EXPECT_EQ(radiance(with, 1), radiance(without, 1));
  EXPECT_EQ(radiance(with, -1), radiance(without, -1));
}

// A closed white skin that lets half of its light through, without absorption inside: a furnace.
TEST(GltfDiffuseTransmission, WhiteBallInUniformLightIsInvisible) {
  Scene material = triangle(R"("diffuseTransmissionFactor":0.5)", R"(,"KHR_materials_volume":{"thicknessFactor":1})");
  SceneBuilder builder;
  Material white = material.materials[0];
  white.base_color = Vec4(1);
  white.specular = 1;
  builder.add_sphere(Vec3(0), 1, builder.add_material(white), 24);
  builder.scene.environment.tint = Vec3(1);
  const Stage stage(builder.scene);
  for (const Integrator integrator : {trace_path, trace_naive}) {
    const Estimate e =
        estimate_radiance(stage, integrator, {Vec3(0.3f, 2, 0.4f), glm::normalize(Vec3(-0.3f, -2, -0.4f))}, 4000);
    EXPECT_NEAR(e.mean.x, 1, 0.01f + 6 * e.standard_error.x);
    EXPECT_LT(e.standard_error.x, 0.01f);
  }
}

}  // namespace
}  // namespace candil::test
