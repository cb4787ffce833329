// Textures of materials: which texel is looked up, and which image is shown.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/error.h"
#include "tests/io/material_sample.h"
#include "tests/support/gltf/ktx2_sample.h"

namespace candil::test {
namespace {

// Rotation of a quarter, counter-clockwise as seen in the image: what is looked up for (u, v) is u' = 2 v + 0.1 and
// v' = -3 u + 0.2 with cos = 0, sin = 1, scale (3, 2), offset (0.1, 0.2). The sample model TextureTransformTest
// fixes the sense of rotation: its arrow, at 45 degrees in the image, is turned by 22.5 degrees onto the marker at (u,
// v) = (0.421, 1.016), which is at 67.5 degrees; the lookup turns back.
TEST(GltfTexture, AppliesTextureTransforms) {
  const TextureSlot slot = load_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":0,
      "extensions":{"KHR_texture_transform":{"offset":[0.1,0.2],"rotation":1.5707963267948966,"scale":[3,2],
      "texCoord":1}}}}})")
                               .base_color_texture;
  EXPECT_EQ(slot.uv_set, 1u);
  const Vec3 expected_u(0, 2, 0.1f), expected_v(-3, 0, 0.2f);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(slot.row_u[i], expected_u[i], 1e-6f);
    EXPECT_NEAR(slot.row_v[i], expected_v[i], 1e-6f);
  }
  const TextureSlot turned = load_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,
      "extensions":{"KHR_texture_transform":{"rotation":0.39269908169872414}}}}})")
                                 .base_color_texture;
  const Vec3 marker(0.421f, 1.016f, 1);
  EXPECT_NEAR(glm::dot(turned.row_u, marker), glm::dot(turned.row_v, marker), 2e-3f) << "on the arrow's diagonal";
}

// Whatever the slot: texture 1, the second uv set, and the transform.
TEST(GltfTexture, AppliesTextureTransformsToEverySlot) {
  const std::string info = R"({"index":1,"texCoord":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0.25],
      "scale":[2,3],"texCoord":1}}})";
  const Material material = load_material(
      R"({"pbrMetallicRoughness":{"baseColorTexture":)" + info + R"(,"metallicRoughnessTexture":)" + info +
      R"(},"normalTexture":)" + info + R"(,"occlusionTexture":)" + info + R"(,"emissiveTexture":)" + info +
      R"(,"extensions":{"KHR_materials_specular":{"specularTexture":)" + info + R"(,"specularColorTexture":)" + info +
      R"(},"KHR_materials_transmission":{"transmissionTexture":)" + info +
      R"(},"KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatTexture":)" + info +
      R"(,"clearcoatRoughnessTexture":)" + info + R"(,"clearcoatNormalTexture":)" + info +
      R"(},"KHR_materials_sheen":{"sheenColorFactor":[1,1,1],"sheenColorTexture":)" + info +
      R"(,"sheenRoughnessTexture":)" + info +
      R"(},"KHR_materials_anisotropy":{"anisotropyStrength":1,"anisotropyTexture":)" + info +
      R"(},"KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceTexture":)" + info +
      R"(,"iridescenceThicknessTexture":)" + info +
      R"(},"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":1,"diffuseTransmissionTexture":)" + info +
      R"(,"diffuseTransmissionColorTexture":)" + info + "}}}");
  int count = 0;
  for_each_texture_slot(material, [&](const TextureSlot& slot) {
    EXPECT_TRUE(slot.is_used()) << "slot " << count;
    EXPECT_EQ(slot.uv_set, 1u) << "slot " << count;
    EXPECT_EQ(slot.row_u, Vec3(2, 0, 0.5f)) << "slot " << count;
    EXPECT_EQ(slot.row_v, Vec3(0, 3, 0.25f)) << "slot " << count;
    ++count;
  });
  EXPECT_EQ(count, 18);
}

TEST(GltfTexture, IgnoresUvSetsBeyondTwo) {
  const LoadedScene loaded =
      load_sample(sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":2}}})"));
  EXPECT_FALSE(loaded.scene.materials.at(0).base_color_texture.is_used());
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.warnings[0],
            "materials[0].pbrMetallicRoughness.baseColorTexture: uses TEXCOORD_2, only 0 and 1 are "
            "supported; it is ignored");
}

TEST(GltfTexture, WarnsOfUvsThatAreMissing) {
  GltfSample sample = sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})");
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]})"};
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.warnings,
            std::vector<std::string>{"meshes[0].primitives[0]: has no TEXCOORD_1 for the textures of its material"});
}

TEST(GltfTexture, SamplersAndSharedImages) {
  GltfSample sample = sample_with_material(
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"emissiveTexture":{"index":1}})");
  sample.samplers = {R"({"wrapS":33071,"wrapT":33648,"magFilter":9728,"minFilter":9987})"};
  sample.textures[0] = R"({"source":0,"sampler":0})";
  sample.textures[1] = R"({"source":1})";
  sample.images.push_back(sample.images[0]);
  sample.images.push_back(R"({"uri":"missing.png"})");  // which no material uses
  const Scene scene = load_sample(sample).scene;
  ASSERT_EQ(scene.textures.size(), 2u);
  EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::mirror);
  EXPECT_EQ(scene.textures[0].filter, Filter::nearest);
  EXPECT_EQ(scene.textures[1].wrap_u, Wrap::repeat);
  EXPECT_EQ(scene.textures[1].filter, Filter::bilinear);
  ASSERT_EQ(scene.images.size(), 1u) << "equal sources are decoded once";
  EXPECT_EQ(scene.images[0].width, 2);
  EXPECT_EQ(scene.images[0].rgba8.at(0), glm::u8vec4(200, 100, 50, 128));
}

TEST(GltfTexture, DecodesImagesInBufferViews) {
  GltfSample sample = sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const int view = sample.add_view(from_base64(png_rgba8));
  sample.images = {"{\"name\":\"packed\",\"mimeType\":\"image/png\",\"bufferView\":" + std::to_string(view) + "}"};
  const Scene scene = load_sample(sample).scene;
  EXPECT_EQ(scene.images.at(0).name, "packed");
  EXPECT_EQ(scene.images[0].rgba8.at(1), glm::u8vec4(10, 20, 30, 0));
}

// A WebP image that cannot be decoded (here since it is none) is replaced by the texture's own source.
TEST(GltfTexture, WebpFallsBackToTheCoreImage) {
  GltfSample sample = sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  sample.textures[0] = R"({"source":0,"extensions":{"EXT_texture_webp":{"source":1}}})";
  sample.images.push_back(R"({"uri":"data:image/webp;base64,AAAA"})");
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.scene.images.at(0).rgba8.at(0), glm::u8vec4(200, 100, 50, 128));
  EXPECT_EQ(loaded.warnings.size(), 1u);
  sample.textures[0] = R"({"extensions":{"EXT_texture_webp":{"source":1}}})";
  EXPECT_NE(load_error(sample).find("images[1].uri"), std::string::npos);
}

// Basis Universal before AVIF before WebP before the core's PNG or JPEG: the first that can be decoded counts, and one
// warning says why an earlier one was not.
TEST(GltfTexture, TakesTheFirstImageThatCanBeDecoded) {
  GltfSample sample = sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  sample.textures[0] = R"({"source":0,"extensions":{"EXT_texture_webp":{"source":2},"EXT_texture_avif":{"source":3},
      "KHR_texture_basisu":{"source":1}}})";
  const std::string ktx2 = R"({"uri":"data:image/ktx2;base64,)" + to_base64(read_test_data("uastc.ktx2")) + "\"}";
  const std::string grey = "{\"uri\":\"data:image/png;base64," + std::string(png_grey8) + "\"}";
  const std::string broken = R"({"uri":"data:application/octet-stream;base64,AAAA"})";
  const auto load = [&](const std::string& basisu, const std::string& webp, const std::string& avif) {
    sample.images.resize(1);
    sample.images.insert(sample.images.end(), {basisu, webp, avif});
    LoadedScene loaded = load_sample(sample);
    EXPECT_EQ(loaded.scene.images.size(), 1u);
    return std::pair(std::move(loaded.scene.images.at(0)), std::move(loaded.warnings));
  };
  const auto [first, no_warnings] = load(ktx2, grey, grey);
  EXPECT_EQ(first.width, 16);
  EXPECT_TRUE(no_warnings.empty());
  // Avif and WebP stand for two pictures here: the format is told by the bytes, whatever the extension.
  const auto [second, warnings] = load(broken, broken, grey);
  EXPECT_EQ(second.rgba8.at(0), glm::u8vec4(7, 7, 7, 255));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("images[1]"), std::string::npos);
  const auto [last, more_warnings] = load(broken, broken, broken);
  EXPECT_EQ(last.rgba8.at(0), glm::u8vec4(200, 100, 50, 128));
  EXPECT_EQ(more_warnings.size(), 1u);
  sample.textures[0] = R"({"extensions":{"KHR_texture_basisu":{"source":1}}})";
  EXPECT_NE(load_error(sample).find("images[1].uri"), std::string::npos);
  sample.textures[0] = R"({"extensions":{"KHR_texture_basisu":{"source":9}}})";
  EXPECT_NE(load_error(sample).find("textures[0].extensions.KHR_texture_basisu.source"), std::string::npos);
}

}  // namespace
}  // namespace candil::test
