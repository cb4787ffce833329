// Materials of glTF files whose appearance their texts fix.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// A square from (-1, -1) to (1, 1) in the plane z = 0, its front towards +z, of materials[0].
GltfSample square(const std::string& material, const std::string& primitive = "") {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 4, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 6, {0, 1, 2, 0, 2, 3});
  sample.add_triangle("", ",\"indices\":1,\"material\":0" + primitive);
  sample.materials = {material};
  return sample;
}

/// A box of half size 1/2, each side as long as the node's `scale`.
GltfSample box(const std::string& material, const std::string& scale) {
  GltfSample sample;
  SceneBuilder builder;
  builder.add_cube(Vec3(0), 0.5f, 0, false);
  std::vector<float> positions;
  std::vector<std::uint8_t> indices;
  for (const Mesh& side : builder.scene.meshes) {
    const auto first = static_cast<std::uint8_t>(positions.size() / 3);
    for (const Vec3 p : side.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    for (const Triangle t : side.triangles) {
      for (int c = 0; c < 3; ++c) indices.push_back(static_cast<std::uint8_t>(first + t[c]));
    }
  }
  sample.add_accessor<float>(gl_float, "VEC3", positions.size() / 3, positions);
  sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", indices.size(), indices);
  sample.add_triangle("", ",\"indices\":1,\"material\":0");
  sample.nodes = {R"({"mesh":0,"scale":)" + scale + "}"};
  sample.materials = {material};
  return sample;
}

/// Radiance along a ray through `target` that comes from `angle` radians beside +z, in the plane y = 0.
Estimate look(Scene scene, float angle, std::uint32_t samples = 64, Vec3 target = Vec3(0.1f, 0.2f, 0)) {
  const Vec3 direction(-std::sin(angle), 0, -std::cos(angle));
  return estimate_radiance(Stage(std::move(scene)), trace_path, {target - 3.0f * direction, direction}, samples);
}

Scene load(const GltfSample& sample, Vec3 sky, const LoadOptions& options = {}) {
  LoadedScene loaded = load_sample(sample, options);
  for (const std::string& warning : loaded.warnings) ADD_FAILURE() << warning;
  loaded.scene.environment.tint = sky;
  return std::move(loaded.scene);
}

TEST(GltfMaterialRender, VariantsDiffer) {
  GltfSample sample = square(R"({"emissiveFactor":[0,0,1]})", R"(,"extensions":{"KHR_materials_variants":{"mappings":[
      {"material":1,"variants":[0]},{"material":2,"variants":[1]}]}})");
  sample.materials.insert(sample.materials.end(), {R"({"emissiveFactor":[1,0,0]})", R"({"emissiveFactor":[0,1,0]})"});
  sample.root = R"(,"extensions":{"KHR_materials_variants":{"variants":[{"name":"a"},{"name":"b"}]}})";
  LoadOptions a, b;
  a.variant = "a", b.variant = "1";
  EXPECT_EQ(look(load(sample, Vec3(0)), 0).mean, Vec3(0, 0, 1));
  EXPECT_EQ(look(load(sample, Vec3(0), a), 0).mean, Vec3(1, 0, 0));
  EXPECT_EQ(look(load(sample, Vec3(0), b), 0).mean, Vec3(0, 1, 0));
}

TEST(GltfMaterialRender, EmissiveStrengthScales) {
  const auto emission = [](const std::string& strength) {
    return look(load(square(R"({"emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{)" +
                            strength + "}}}"),
                     Vec3(0)),
                0)
        .mean;
  };
  EXPECT_EQ(emission(""), Vec3(1, 0.5f, 0));
  EXPECT_EQ(emission(R"("emissiveStrength":20000)"), Vec3(20000, 10000, 0));
  EXPECT_EQ(emission(R"("emissiveStrength":0)"), Vec3(0));
}

// KHR_materials_specular: f0 = 0 where the specular colour is black, f90 = 1 stays: Schlick's term is (1 - cos)^5. On
// black, under a sky of 1, what is seen is the Fresnel term: nothing straight on, 1/32 at 60 degrees; 0.04 and
// 0.04 + 0.96/32 = 0.07 with the default, white. A channel may be black alone.
TEST(GltfMaterialRender, BlackSpecularColorReflectsNothingAtNormalIncidence) {
  const auto reflection = [](const std::string& color, float angle) {
    return look(load(square(R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0,
                              "roughnessFactor":0},"extensions":{"KHR_materials_specular":{)" +
                            color + "}}}"),
                     Vec3(1)),
                angle, 256);
  };
  const std::string green = R"("specularColorFactor":[0,1,0])";
  for (const auto& [angle, black, white] : {std::tuple(0.0f, 0.0f, 0.04f), std::tuple(pi / 3, 1 / 32.0f, 0.07f)}) {
    const Vec3 seen = reflection(green, angle).mean;
    EXPECT_NEAR(seen.x, black, 1e-4f);
    EXPECT_NEAR(seen.y, white, 2e-4f);
    EXPECT_NEAR(seen.z, black, 1e-4f);
    EXPECT_NEAR(reflection("", angle).mean.x, white, 2e-4f);
  }
}

// Without a step of the index there is neither reflection nor refraction, whatever the angle, for a sheet and for a
// body: a striped wall behind it is seen as if it were not there.
TEST(GltfMaterialRender, IndexOneIsInvisible) {
  for (const char* volume : {"", R"(,"KHR_materials_volume":{"thicknessFactor":1})"}) {
    for (const float angle : {0.0f, 0.7f, 1.2f}) {
      const std::string material = R"({"pbrMetallicRoughness":{"roughnessFactor":0,"metallicFactor":0},
          "extensions":{"KHR_materials_ior":{"ior":1},"KHR_materials_transmission":{"transmissionFactor":1})" +
                                   std::string(volume) + "}}";
      const auto with_wall = [&](Scene scene) {
        SceneBuilder builder;
        builder.scene = std::move(scene);
        for (int stripe = 0; stripe < 40; ++stripe) {
          const float brightness = 1 + static_cast<float>(stripe % 7);
          builder.add_quad(Vec3(-10 + 0.5f * static_cast<float>(stripe), -5, -2), Vec3(0.5f, 0, 0), Vec3(0, 10, 0),
                           builder.add_diffuse(Vec3(0), Vec3(brightness)));
        }
        return std::move(builder.scene);
      };
      const GltfSample glass = *volume == 0 ? square(material) : box(material, "[1,1,1]");
      Scene nothing;
      const Vec3 target(0.1f, 0.2f, 0.1f);
      const Vec3 expected = look(with_wall(std::move(nothing)), angle, 4, target).mean;
      expect_radiance(look(with_wall(load(glass, Vec3(0))), angle, 64, target), expected);
      EXPECT_GE(expected.x, 1);
    }
  }
}

// A slab of index 1.5 and thickness L, straight on, under a sky of 1: of what enters, a = c^(L / d) arrives at the
// other side (Beer-Lambert), R = 0.04 is reflected at each: R + (1 - R)^2 a (1 + R a + (R a)^2 + ...) = R + (1 - R)^2 a
// / (1 - R a). The attenuation distance d is in metres of the world, and so is the way of the rays: a node's scale
// counts.
TEST(GltfMaterialRender, SlabsAttenuateByBeerLambert) {
  const std::string material = R"({"pbrMetallicRoughness":{"roughnessFactor":0,"metallicFactor":0},"extensions":{
      "KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_volume":{"thicknessFactor":0.1,
      "attenuationDistance":0.5,"attenuationColor":[0.9,0.5,0.1]}}})";
  for (const auto& [scale, thickness] : {std::pair("[1,1,1]", 1.0f), std::pair("[3,3,0.25]", 0.25f)}) {
    Vec3 expected;
    for (int c = 0; c < 3; ++c) {
      const float a = std::pow(Vec3(0.9f, 0.5f, 0.1f)[c], thickness / 0.5f), r = 0.04f;
      expected[c] = r + (1 - r) * (1 - r) * a / (1 - r * a);
    }
    const Estimate seen = look(load(box(material, scale), Vec3(1)), 0, 40000);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(seen.mean[c], expected[c], 6 * seen.standard_error[c] + 1e-4f) << "thickness " << thickness;
      EXPECT_LT(seen.standard_error[c], 0.03f * expected[c]);
    }
  }
}

// The base colour, its vertex colours included, is the radiance, whatever shines.
TEST(GltfMaterialRender, UnlitShowsItsBaseColour) {
  GltfSample sample = square(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1]},"emissiveFactor":[1,1,1],
      "extensions":{"KHR_materials_unlit":{}}})");
  sample.add_accessor<float>(gl_float, "VEC3", 4, {1, 0.5f, 0, 1, 0.5f, 0, 1, 0.5f, 0, 1, 0.5f, 0});
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0}]})"};
  for (const float sky : {0.0f, 1.0f, 100.0f}) {
    for (const float angle : {0.0f, 1.3f}) {
      Scene scene = load(sample, Vec3(sky));
      PunctualLight lamp;
      lamp.position = Vec3(0, 0, 1), lamp.intensity = Vec3(sky);
      scene.punctual_lights = {lamp};
      const Vec3 seen = look(std::move(scene), angle).mean, expected(0.5f, 0.125f, 0);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], 1e-6f) << "sky " << sky;
    }
  }
}

// KHR_mesh_quantization: integers that stand for the same numbers make the same picture, bit by bit.
TEST(GltfMaterialRender, QuantisedEqualsFloat) {
  const std::string material = R"({"pbrMetallicRoughness":{"metallicFactor":0.5,"roughnessFactor":0.3}})";
  GltfSample floats, integers;
  floats.add_accessor<float>(gl_float, "VEC3", 4, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
  floats.add_accessor<float>(gl_float, "VEC3", 4, {0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, 1});
  // Elements of bytes are padded to 4 bytes.
  integers.add_accessor<std::int8_t>(gl_byte, "VEC3", 4,
                                     {-127, -127, 0, 0, 127, -127, 0, 0, 127, 127, 0, 0, -127, 127, 0, 0},
                                     R"(,"normalized":true)");
  integers.add_accessor<std::int8_t>(gl_byte, "VEC3", 4, {0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 0, 127, 0},
                                     R"(,"normalized":true)");
  for (std::string& view : integers.views) view.insert(view.size() - 1, R"(,"byteStride":4)");
  const auto render = [&](GltfSample sample) {
    sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 6, {0, 1, 2, 0, 2, 3});
    sample.add_triangle(",\"NORMAL\":1", ",\"indices\":2,\"material\":0");
    sample.materials = {material};
    return look(load(sample, Vec3(1, 2, 3)), 0.5f).mean;
  };
  integers.root = R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
  const Vec3 seen = render(floats);
  EXPECT_EQ(render(integers), seen);
  EXPECT_GT(seen.x, 0.1f);
}

}  // namespace
}  // namespace candil::test
