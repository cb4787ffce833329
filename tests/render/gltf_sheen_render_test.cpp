// KHR_materials_sheen in files: what its text says about a triangle in the light of a plain sky.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// Radiance of the triangle (0 0 0), (1 0 0), (0 1 0), its front towards +z, seen at that cosine under a sky of
/// radiance 1.
Vec3 seen(const std::string& base_color, const std::string& sheen, float cosine, std::uint32_t samples = 4096) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":)" + base_color +
                      R"(},"extensions":{"KHR_materials_specular":{"specularFactor":0})" + sheen + "}}"};
  sample.root = R"(,"extensionsUsed":["KHR_materials_sheen","KHR_materials_specular"])";
  Scene scene = load_sample(sample).scene;
  scene.environment = {};
  scene.environment.tint = Vec3(1);
  const Vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
  return estimate_radiance(Stage(std::move(scene)), trace_path, Ray{Vec3(0.25f, 0.25f, 0) + wo, -wo}, samples).mean;
}

std::string sheen(const std::string& color, const std::string& roughness) {
  return R"(,"KHR_materials_sheen":{"sheenColorFactor":)" + color + R"(,"sheenRoughnessFactor":)" + roughness + "}";
}

TEST(GltfSheen, OfBlackIsNone) {
  const Vec3 none = seen("[0.8,0.3,0.1,1]", "", 0.4f, 64);
  EXPECT_EQ(none, seen("[0.8,0.3,0.1,1]", sheen("[0,0,0]", "0.5"), 0.4f, 64));
  EXPECT_NE(none, seen("[0.8,0.3,0.1,1]", sheen("[1,1,1]", "0.5"), 0.4f, 64));
}

// sheen_material = sheenColor sheen_brdf + material (1 - max3(sheenColor) E(VdotN)): white on white stays white, and of
// a base of 0.5 below sheen of 0.5 the component that has no sheen keeps 0.5 (1 - 0.5 E). E is the albedo of the
// extension's formulas, integrated in double precision by midpoints (tests/materials/sheen_test.cpp has the integral):
// E(0.2) = 0.4202 and E(0.7) = 0.1049 for a roughness of 0.5.
TEST(GltfSheen, TakesFromTheBaseWhatItReflects) {
  for (const auto& [cosine, albedo] : {std::pair(0.2f, 0.4202f), std::pair(0.7f, 0.1049f)}) {
    EXPECT_NEAR(seen("[1,1,1,1]", sheen("[1,1,1]", "0.5"), cosine).x, 1, 0.01f);
    const Vec3 black = seen("[0,0,0,1]", sheen("[1,0.5,0]", "0.5"), cosine);
    EXPECT_NEAR(black.x, albedo, 0.01f * albedo);
    EXPECT_NEAR(black.y, 0.5f * albedo, 0.01f * albedo);
    EXPECT_EQ(black.z, 0);
    const Vec3 grey = seen("[0.5,0.5,0.5,1]", sheen("[0.5,0,0]", "0.5"), cosine);
    EXPECT_NEAR(grey.x, 0.5f * albedo + 0.5f * (1 - 0.5f * albedo), 0.01f);
    EXPECT_NEAR(grey.z, 0.5f * (1 - 0.5f * albedo), 0.01f);
  }
}

}  // namespace
}  // namespace candil::test
