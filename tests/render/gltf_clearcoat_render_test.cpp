// KHR_materials_clearcoat in files: what its text and its formula say about a triangle in the light of a plain sky.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

const std::string black = R"("pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0})";
const std::string no_specular = R"("KHR_materials_specular":{"specularFactor":0})";

/// The triangle (0 0 0), (1 0 0), (0 1 0) with its front towards +z, under a sky of radiance 1 or none.
Scene triangle(const std::string& members, const std::string& extensions, bool has_sky = true) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {"{" + members + ",\"extensions\":{" + extensions + "}}"};
  sample.root = R"(,"extensionsUsed":["KHR_materials_clearcoat","KHR_materials_specular"])";
  Scene scene = load_sample(sample).scene;
  scene.environment = {};
  scene.environment.tint = Vec3(has_sky ? 1.0f : 0.0f);
  return scene;
}

/// Radiance that a viewer sees at that cosine.
Vec3 seen(Scene scene, float cosine, std::uint32_t samples = 1024) {
  const Vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
  return estimate_radiance(Stage(std::move(scene)), trace_path, Ray{Vec3(0.25f, 0.25f, 0) + wo, -wo}, samples).mean;
}

// coated_material = mix(material, clearcoat_brdf, clearcoat (0.04 + 0.96 (1 - VdotNc)^5)): on black a smooth coat alone
// is left, 0.04 from above, 0.04 + 0.96 / 32 = 0.07 at 60 degrees, 0.04 + 0.96 * 0.8^5 = 0.354573 at a cosine of 0.2.
TEST(GltfClearcoat, ReflectsBySchlickOnBlack) {
  const std::string half = R"("KHR_materials_clearcoat":{"clearcoatFactor":0.5})";
  for (const auto& [cosine, expected] : {std::pair(1.0f, 0.04f), std::pair(0.5f, 0.07f), std::pair(0.2f, 0.354573f)}) {
    const std::string full = R"("KHR_materials_clearcoat":{"clearcoatFactor":1})";
    EXPECT_NEAR(seen(triangle(black, full + "," + no_specular), cosine, 16).x, expected, 1e-4f);
    EXPECT_NEAR(seen(triangle(black, half + "," + no_specular), cosine, 16).x, 0.5f * expected, 1e-4f);
  }
}

TEST(GltfClearcoat, OfZeroIsNone) {
  const std::string base = R"("pbrMetallicRoughness":{"baseColorFactor":[0.8,0.3,0.1,1],"roughnessFactor":0.4})";
  const Vec3 none = seen(triangle(base, ""), 0.4f, 64);
  const Vec3 zero = seen(
      triangle(base, R"("KHR_materials_clearcoat":{"clearcoatFactor":0,"clearcoatRoughnessFactor":0.3})"), 0.4f, 64);
  EXPECT_EQ(none, zero);
  EXPECT_NE(none, seen(triangle(base, R"("KHR_materials_clearcoat":{"clearcoatFactor":1})"), 0.4f, 64));
}

// What the coat reflects it takes from the base: white under a white sky stays white, smooth or rough.
TEST(GltfClearcoat, KeepsWhiteWhite) {
  const std::string white = R"("pbrMetallicRoughness":{"metallicFactor":0})";
  for (const char* const roughness : {"0", "0.5"}) {
    const std::string coat =
        R"("KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":)" + std::string(roughness) + "}";
    for (const float cosine : {1.0f, 0.5f, 0.1f}) {
      EXPECT_NEAR(seen(triangle(white, coat), cosine, 4096).x, 1, 0.01f) << roughness << " at " << cosine;
    }
  }
}

/// A texture of one texel that tilts normals by the tangent of an angle towards +x, and tangents that make it so.
TextureSlot add_tilt(Scene& scene, float tangent) {
  const Vec3 n = glm::normalize(Vec3(tangent, 0, 1));
  TextureImage image;
  image.width = image.height = 1;
  image.rgba32 = {Vec4(0.5f * n + 0.5f, 1)};
  scene.images.push_back(image);
  scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1)});
  for (Mesh& mesh : scene.meshes) {
    mesh.uvs[0].assign(mesh.positions.size(), Vec2(0.5f));
    mesh.tangents.assign(mesh.positions.size(), Vec4(1, 0, 0, 1));
  }
  TextureSlot slot;
  slot.texture = static_cast<std::uint32_t>(scene.textures.size() - 1);
  return slot;
}

// From 60 degrees a viewer sees a light at 60 degrees on the other side, with 0.07 of its radiance. The base's normal
// map does not move it; a coat's that tilts by 20 degrees moves the mirror direction by 40, off the light.
TEST(GltfClearcoat, HasItsOwnNormal) {
  const std::string coat = R"("KHR_materials_clearcoat":{"clearcoatFactor":1})";
  const auto radiance = [&](bool is_base_tilted, bool is_coat_tilted) {
    SceneBuilder builder;
    builder.scene = triangle(black, coat + "," + no_specular, false);
    Material& material = builder.scene.materials[0];
    const TextureSlot tilt = add_tilt(builder.scene, std::tan(glm::radians(20.0f)));
    if (is_base_tilted) material.normal_texture = tilt;
    if (is_coat_tilted) material.extensions->clearcoat_normal_texture = tilt;
    const Vec3 center = Vec3(0.25f, 0.25f, 0) + 4.0f * Vec3(-std::sqrt(0.75f), 0, 0.5f);
    builder.add_quad(center - Vec3(0, 0.5f, 0.5f), Vec3(0, 1, 0), Vec3(0, 0, 1),
                     builder.add_diffuse(Vec3(0), Vec3(10)));
    return seen(std::move(builder.scene), 0.5f, 16).x;
  };
  EXPECT_NEAR(radiance(false, false), 0.7f, 1e-3f);
  EXPECT_NEAR(radiance(true, false), 0.7f, 1e-3f);
  EXPECT_EQ(radiance(false, true), 0);
}

}  // namespace
}  // namespace candil::test
