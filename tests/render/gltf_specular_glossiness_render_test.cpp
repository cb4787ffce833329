// KHR_materials_pbrSpecularGlossiness beside the metallic-roughness materials that its text says are the same.
#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// Radiance of a triangle of that material in coloured light from a part of the sky.
Vec3 appearance(const std::string& material) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");  // in the plane z = 0, its front towards +z
  sample.materials = {material};
  sample.root = R"(,"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],
                    "extensionsRequired":["KHR_materials_pbrSpecularGlossiness"])";
  Scene scene = load_sample(sample).scene;
  SceneBuilder sky;
  sky.scene = std::move(scene);
  sky.add_quad(Vec3(-2, 3, 4), Vec3(0, -4, 0), Vec3(3, 0, 0), sky.add_diffuse(Vec3(0), Vec3(1, 2, 3)));
  const Ray ray{Vec3(1.2f, 0.2f, 1), glm::normalize(Vec3(0.2f, 0.2f, 0) - Vec3(1.2f, 0.2f, 1))};
  return estimate_radiance(Stage(sky.scene), trace_path, ray, 256).mean;
}

/// Same numbers, same paths: what differs is rounding.
void expect_alike(const std::string& specular_glossiness, const std::string& metallic_roughness) {
  const Vec3 a = appearance(R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + specular_glossiness + "}}}");
  const Vec3 b = appearance(R"({"pbrMetallicRoughness":{)" + metallic_roughness + "}}");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-4f * b[c] + 1e-6f) << specular_glossiness;
  EXPECT_GT(max_component(b), 0.01f) << "nothing to be seen";
}

// The text: the specular of a metal is its base colour, and glossiness is 1 - roughness.
TEST(GltfSpecularGlossiness, MetalsAreThoseOfMetallicRoughness) {
  expect_alike(R"("diffuseFactor":[0,0,0,1],"specularFactor":[1,0.766,0.336],"glossinessFactor":0.75)",
               R"("baseColorFactor":[1,0.766,0.336,1],"metallicFactor":1,"roughnessFactor":0.25)");
}

// A specular of 0.04 is that of index 1.5, and takes 4 % from the diffuse: 0.75 x 0.96 = 0.72, 0.5 x 0.96 = 0.48.
TEST(GltfSpecularGlossiness, SpecularIsTakenFromDiffuse) {
  expect_alike(R"("diffuseFactor":[0.75,0.5,0.25,1],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.5)",
               R"("baseColorFactor":[0.72,0.48,0.24,1],"metallicFactor":0,"roughnessFactor":0.5)");
}

// The defaults: specular white, which leaves nothing for diffuse, and full glossiness.
TEST(GltfSpecularGlossiness, DefaultIsAPerfectMirror) {
  expect_alike(R"("glossinessFactor":0)", R"("metallicFactor":1,"roughnessFactor":1)");
  const Vec3 mirror = appearance(R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}})");
  // The ray (-1, 0, -1) from above becomes (-1, 0, 1): from x = 0.2 it meets the light's plane at x = -3.8, beside it.
  EXPECT_EQ(mirror, Vec3(0));
}

}  // namespace
}  // namespace candil::test
