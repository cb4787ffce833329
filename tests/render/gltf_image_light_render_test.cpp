// EXT_lights_image_based as a light: what a diffuse surface shows under one bright face of the cube.
#include <gtest/gtest.h>

#include "io/image_file.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

std::string png_uri(float value) {
  Image image(64, 64, 3);
  for (float& channel : image.pixels) channel = value;
  return "{\"uri\":\"data:image/png;base64," + to_base64(encode_png(image, false)) + "\"}";
}

/// Faces are black but for -Y, which is white; the cube is turned by `rotation`.
Environment load_environment(const std::string& rotation) {
  const LoadedScene loaded =
      load_text(R"({"asset":{"version":"2.0"},"images":[)" + png_uri(0) + "," + png_uri(1) +
                R"(],"extensions":{"EXT_lights_image_based":{"lights":[{"intensity":3,
      "irradianceCoefficients":[],"specularImageSize":64,"specularImages":[[0,0,0,1,0,0]],"rotation":)" +
                rotation + R"(}]}},"scene":0,"scenes":[{"extensions":{"EXT_lights_image_based":{"light":0}}}]})");
  EXPECT_TRUE(loaded.warnings.empty());
  return loaded.scene.environment;
}

Estimate shown_by_a_floor(const Environment& environment) {
  SceneBuilder builder;
  builder.add_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_diffuse(Vec3(0.5f)));
  builder.scene.environment = environment;
  const Ray down{Vec3(0.3f, 2, 0.4f), glm::normalize(Vec3(-0.3f, -2, -0.4f))};
  return estimate_radiance(Stage(builder.scene), trace_path, down, 40000);
}

// Half a turn about +X brings the white face overhead. The form factor of a small floor to the square that ends at 45
// degrees to each side is four times that of a corner, 1 / (2 pi) (2 / sqrt(2) atan(1 / sqrt(2))) (Howell, A Catalog of
// Radiation Heat Transfer Configuration Factors, B-4, with X = Y = 1): 0.554126. Albedo 1/2, intensity 3.
TEST(GltfImageLightRender, LightsAFloorFromOneFace) {
  expect_radiance(shown_by_a_floor(load_environment("[1,0,0,0]")), Vec3(3 * 0.5f * 0.554126f));
  EXPECT_EQ(shown_by_a_floor(load_environment("[0,0,0,1]")).mean, Vec3(0)) << "from below";
}

// A quarter about +Z, (0, 0, sin 45, cos 45), carries -Y to +X.
TEST(GltfImageLightRender, IsSeenBehindTheScene) {
  Scene scene;
  scene.environment = load_environment("[0,0,0.70710678,0.70710678]");
  const Stage stage(scene);
  const auto seen = [&](Vec3 direction) {
    return estimate_radiance(stage, trace_path, {Vec3(0), glm::normalize(direction)}, 1).mean;
  };
  EXPECT_NEAR(seen(Vec3(1, 0.9f, -0.9f)).y, 3, 1e-4f);
  EXPECT_NEAR(seen(Vec3(1, -0.9f, 0.9f)).y, 3, 1e-4f);
  EXPECT_EQ(seen(Vec3(1, 1.1f, 0)), Vec3(0));
  EXPECT_EQ(seen(Vec3(0, -1, 0)), Vec3(0));
}

}  // namespace
}  // namespace candil::test
