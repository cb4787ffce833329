#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/error.h"
#include "tests/io/image_samples.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/gltf/ktx2_sample.h"

namespace candil::test {
namespace {

const std::string png_uri = "data:image/png;base64," + std::string(png_rgba8);

/// One triangle with both uv sets and the material; textures 0 to 3 all show the same image.
GltfSample sample_with_material(const std::string& material) {
  GltfSample sample;
  sample.add_triangle(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":1", ",\"material\":0");
  sample.add_accessor<float>(gl_float, "VEC2", 3, {0, 0, 1, 0, 0, 1});
  sample.materials = {material};
  sample.images = {"{\"uri\":\"" + png_uri + "\"}"};
  sample.textures = {R"({"source":0})", R"({"source":0})", R"({"source":0})", R"({"source":0})"};
  return sample;
}

const LoadOptions all_extensions = [] {
  LoadOptions options;
  options.experiments = {"KHR_materials_volume_scatter"};
  return options;
}();

Material load_material(const std::string& json) {
  return load_sample(sample_with_material(json), all_extensions).scene.materials.at(0);
}

TEST(GltfMaterial, DefaultsAreThoseOfTheSpecification) {
  for (const char* json : {"{}", R"({"pbrMetallicRoughness":{}})"}) {
    const Material material = load_material(json);
    EXPECT_EQ(material.base_color, Vec4(1));
    EXPECT_EQ(material.metallic, 1);
    EXPECT_EQ(material.roughness, 1);
    EXPECT_EQ(material.emission, Vec3(0));
    EXPECT_EQ(material.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(material.alpha_cutoff, 0.5f);
    EXPECT_FALSE(material.is_double_sided);
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.specular, 1);
    EXPECT_EQ(material.transmission, 0);
    EXPECT_FALSE(material.base_color_texture.is_used());
  }
}

TEST(GltfMaterial, ReadsCoreFactors) {
  const Material material = load_material(R"({"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],
      "metallicFactor":0.5,"roughnessFactor":0.25},"emissiveFactor":[0,0.5,1],"alphaMode":"MASK","alphaCutoff":0.75,
      "doubleSided":true,"normalTexture":{"index":0,"scale":-2},"occlusionTexture":{"index":1,"strength":0.5,"texCoord":1}})");
  EXPECT_EQ(material.name, "m");
  EXPECT_EQ(material.base_color, Vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallic, 0.5f);
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_EQ(material.emission, Vec3(0, 0.5f, 1));
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.75f);
  EXPECT_TRUE(material.is_double_sided);
  EXPECT_EQ(material.normal_scale, -2);
  EXPECT_EQ(material.occlusion_strength, 0.5f);
  EXPECT_EQ(material.occlusion_texture.uv_set, 1u);
}

TEST(GltfMaterial, ReadsExtensions) {
  const Material material = load_material(R"({"emissiveFactor":[1,0.5,0],"alphaMode":"BLEND","extensions":{
      "KHR_materials_emissive_strength":{"emissiveStrength":3000000000},"KHR_materials_ior":{"ior":1.33},
      "KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[2,1,0],"specularTexture":{"index":0},
        "specularColorTexture":{"index":1,"texCoord":1}},
      "KHR_materials_transmission":{"transmissionFactor":0.75,"transmissionTexture":{"index":2}},
      "KHR_materials_volume":{"thicknessFactor":2,"attenuationDistance":0.5,"attenuationColor":[1,0.5,0.25]}}})");
  EXPECT_EQ(material.emission, Vec3(3e9f, 1.5e9f, 0)) << "an integer of more than 31 bits";
  EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
  EXPECT_EQ(material.ior, 1.33f);
  EXPECT_EQ(material.specular, 0.5f);
  EXPECT_EQ(material.specular_color, Vec3(2, 1, 0));
  EXPECT_TRUE(material.specular_texture.is_used());
  EXPECT_EQ(material.specular_color_texture.uv_set, 1u);
  EXPECT_EQ(material.transmission, 0.75f);
  EXPECT_TRUE(material.transmission_texture.is_used());
  EXPECT_EQ(material.thickness, 2);
  EXPECT_EQ(material.attenuation_distance, 0.5f);
  EXPECT_EQ(material.attenuation_color, Vec3(1, 0.5f, 0.25f));
}

// Sides count for unlit materials too: one that transmitted would be seen from behind.
TEST(GltfMaterial, UnlitExcludesOtherExtensions) {
  const Material material = load_material(R"({"extensions":{"KHR_materials_unlit":{},
      "KHR_materials_transmission":{"transmissionFactor":1},
      "KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0,0,0,1]}}})");
  EXPECT_TRUE(material.is_unlit);
  EXPECT_FALSE(material.is_transmissive());
  EXPECT_EQ(material.base_color, Vec4(1));
}

TEST(GltfMaterial, ReadsSpecularGlossinessInsteadOfMetallicRoughness) {
  const Material material = load_material(R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,0],
      "metallicFactor":0.5,"metallicRoughnessTexture":{"index":0}},"extensions":{
      "KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.1,0.2,0.3,0.4],"specularFactor":[0.5,0.6,0.7],
        "glossinessFactor":0.75,"diffuseTexture":{"index":1},"specularGlossinessTexture":{"index":2,"texCoord":1}},
      "KHR_materials_transmission":{"transmissionFactor":1}}})");
  EXPECT_EQ(material.model, MaterialModel::specular_glossiness);
  EXPECT_EQ(material.base_color, Vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.specular_color, Vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_TRUE(material.base_color_texture.is_used());
  EXPECT_EQ(material.specular_color_texture.uv_set, 1u);
  EXPECT_FALSE(material.metallic_roughness_texture.is_used());
  EXPECT_EQ(material.transmission, 0) << "which its text excludes";
  const Material defaults = load_material(R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,0],
      "baseColorTexture":{"index":0}},"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}})");
  EXPECT_EQ(defaults.base_color, Vec4(1));
  EXPECT_FALSE(defaults.base_color_texture.is_used());
  EXPECT_EQ(defaults.specular_color, Vec3(1));
  EXPECT_EQ(defaults.roughness, 0);
}

TEST(GltfMaterial, ReadsLayers) {
  const Material material = load_material(R"({"extensions":{
      "KHR_materials_clearcoat":{"clearcoatFactor":0.5,"clearcoatTexture":{"index":0},"clearcoatRoughnessFactor":0.25,
        "clearcoatRoughnessTexture":{"index":1},"clearcoatNormalTexture":{"index":2,"scale":-2}},
      "KHR_materials_sheen":{"sheenColorFactor":[0.1,0.2,0.3],"sheenColorTexture":{"index":3},
        "sheenRoughnessFactor":0.75,"sheenRoughnessTexture":{"index":0}},
      "KHR_materials_anisotropy":{"anisotropyStrength":0.5,"anisotropyRotation":-7,"anisotropyTexture":{"index":1}},
      "KHR_materials_iridescence":{"iridescenceFactor":0.5,"iridescenceTexture":{"index":2},"iridescenceIor":1.8,
        "iridescenceThicknessMinimum":500,"iridescenceThicknessMaximum":200,"iridescenceThicknessTexture":{"index":3}},
      "KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.5,"diffuseTransmissionTexture":{"index":0},
        "diffuseTransmissionColorFactor":[1,0.5,0.25],"diffuseTransmissionColorTexture":{"index":1}},
      "KHR_materials_volume_scatter":{"multiscatterColor":[0.5,0.25,0],"scatterAnisotropy":-0.5},
      "KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_volume":{"thicknessFactor":1},
      "KHR_materials_dispersion":{"dispersion":2}}})");
  ASSERT_TRUE(material.extensions);
  const MaterialExtensions& more = *material.extensions;
  EXPECT_EQ(more.clearcoat, 0.5f);
  EXPECT_EQ(more.clearcoat_roughness, 0.25f);
  EXPECT_EQ(more.clearcoat_normal_scale, -2);
  EXPECT_EQ(more.sheen_color, Vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(more.sheen_roughness, 0.75f);
  EXPECT_EQ(more.anisotropy, 0.5f);
  EXPECT_EQ(more.anisotropy_rotation, -7);
  EXPECT_EQ(more.iridescence, 0.5f);
  EXPECT_EQ(more.iridescence_ior, 1.8f);
  EXPECT_EQ(more.iridescence_thickness_low, 500);
  EXPECT_EQ(more.iridescence_thickness, 200);
  EXPECT_EQ(more.dispersion, 2);
  EXPECT_EQ(more.diffuse_transmission, 0.5f);
  EXPECT_EQ(more.diffuse_transmission_color, Vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(more.multiscatter_color, Vec3(0.5f, 0.25f, 0));
  EXPECT_EQ(more.scatter_anisotropy, -0.5f);
  const std::array slots = {&more.clearcoat_texture,
                            &more.clearcoat_roughness_texture,
                            &more.clearcoat_normal_texture,
                            &more.sheen_color_texture,
                            &more.sheen_roughness_texture,
                            &more.anisotropy_texture,
                            &more.iridescence_texture,
                            &more.iridescence_thickness_texture,
                            &more.diffuse_transmission_texture,
                            &more.diffuse_transmission_color_texture};
  for (std::size_t i = 0; i < slots.size(); ++i) EXPECT_TRUE(slots[i]->is_used()) << i;
}

TEST(GltfMaterial, DefaultsOfLayersAreThoseOfTheirTexts) {
  const MaterialExtensions more = *load_material(R"({"extensions":{
      "KHR_materials_clearcoat":{"clearcoatFactor":1},"KHR_materials_sheen":{"sheenColorFactor":[1,1,1]},
      "KHR_materials_anisotropy":{"anisotropyStrength":1},"KHR_materials_iridescence":{"iridescenceFactor":1},
      "KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":1}}})")
                                       .extensions;
  EXPECT_EQ(more.clearcoat_roughness, 0);
  EXPECT_EQ(more.sheen_roughness, 0);
  EXPECT_EQ(more.anisotropy_rotation, 0);
  EXPECT_EQ(more.iridescence_ior, 1.3f);
  EXPECT_EQ(more.iridescence_thickness_low, 100);
  EXPECT_EQ(more.iridescence_thickness, 400);
  EXPECT_EQ(more.dispersion, 0);
  EXPECT_EQ(more.diffuse_transmission_color, Vec3(1));
  EXPECT_EQ(more.multiscatter_color, Vec3(0));
}

// Materials without an effect of any extension must not pay for it: neither time nor textures.
TEST(GltfMaterial, LayersWithoutEffectAreAbsent) {
  for (const char* extensions :
       {R"("KHR_materials_clearcoat":{"clearcoatTexture":{"index":0}})",
        R"("KHR_materials_sheen":{"sheenRoughnessFactor":1,"sheenColorTexture":{"index":0}})",
        R"("KHR_materials_anisotropy":{"anisotropyRotation":1,"anisotropyTexture":{"index":0}})",
        R"("KHR_materials_iridescence":{"iridescenceTexture":{"index":0}})",
        R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionTexture":{"index":0}})",
        R"("KHR_materials_volume_scatter":{"scatterAnisotropy":0.5})",
        R"("KHR_materials_dispersion":{"dispersion":1},"KHR_materials_transmission":{"transmissionFactor":1})",
        R"("KHR_materials_unlit":{},"KHR_materials_clearcoat":{"clearcoatFactor":1})"}) {
    const Scene scene = load_sample(sample_with_material(R"({"extensions":{)" + std::string(extensions) + "}}")).scene;
    EXPECT_FALSE(scene.materials.at(0).extensions) << extensions;
    EXPECT_TRUE(scene.images.empty()) << extensions;
  }
}

TEST(GltfMaterial, ClampsFactorsOfLayersAndSaysSo) {
  const LoadedScene loaded = load_sample(sample_with_material(R"({"extensions":{
      "KHR_materials_clearcoat":{"clearcoatFactor":2,"clearcoatRoughnessFactor":-1},
      "KHR_materials_sheen":{"sheenColorFactor":[2,0,0]},"KHR_materials_anisotropy":{"anisotropyStrength":1.5},
      "KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceIor":0.5,"iridescenceThicknessMinimum":-1},
      "KHR_materials_volume_scatter":{"multiscatterColorFactor":[1,1,1],"scatterAnisotropy":-1}}})"));
  const MaterialExtensions more = *loaded.scene.materials.at(0).extensions;
  EXPECT_EQ(more.clearcoat, 1);
  EXPECT_EQ(more.clearcoat_roughness, 0);
  EXPECT_EQ(more.sheen_color, Vec3(1, 0, 0));
  EXPECT_EQ(more.anisotropy, 1);
  EXPECT_EQ(more.iridescence_ior, 1);
  EXPECT_EQ(more.iridescence_thickness_low, 0);
  EXPECT_LT(more.multiscatter_color.x, 1);
  EXPECT_GT(more.scatter_anisotropy, -1);
  ASSERT_EQ(loaded.warnings.size(), 8u);
  EXPECT_EQ(loaded.warnings[0],
            "materials[0].extensions.KHR_materials_volume_scatter.multiscatterColorFactor: 1 is out of range, 0.9999 "
            "is used");
}

TEST(GltfMaterial, LayersAreCheckedBeforeTheyAreRead) {
  for (const auto& [extension, place] : std::vector<std::pair<std::string, std::string>>{
           {R"("KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":9}})", "clearcoatNormalTexture.index"},
           {R"("KHR_materials_sheen":{"sheenColorFactor":[1,1]})", "sheenColorFactor"},
           {R"("KHR_materials_anisotropy":{"anisotropyTexture":{}})", "anisotropyTexture.index"},
           {R"("KHR_materials_iridescence":{"iridescenceIor":"glass"})", "iridescenceIor"},
           {R"("KHR_materials_dispersion":{"dispersion":[]})", "dispersion"},
           {R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionTexture":7})", "diffuseTransmissionTexture"},
           {R"("KHR_materials_volume_scatter":{"multiscatterColor":1})", "multiscatterColor"}}) {
    const std::string error = load_error(sample_with_material(R"({"extensions":{)" + extension + "}}"));
    EXPECT_NE(error.find("materials[0].extensions.KHR_materials_"), std::string::npos) << error;
    EXPECT_NE(error.find(place + ":"), std::string::npos) << error;
  }
}

// Anisotropy and the normals of a coat need a tangent space also where the base has no normal texture.
TEST(GltfMaterial, LayersGetTangents) {
  for (const char* extension :
       {R"("KHR_materials_anisotropy":{"anisotropyStrength":1})",
        R"("KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatNormalTexture":{"index":0}})"}) {
    const LoadedScene loaded = load_sample(sample_with_material(R"({"extensions":{)" + std::string(extension) + "}}"));
    ASSERT_FALSE(loaded.scene.meshes.at(0).tangents.empty()) << extension;
    EXPECT_EQ(loaded.scene.meshes[0].tangents[0], Vec4(1, 0, 0, -1)) << "u along +X, v along +Y";
  }
}

TEST(GltfMaterial, ClampsFactorsOutOfRangeAndSaysSo) {
  const LoadedScene loaded = load_sample(sample_with_material(R"({"pbrMetallicRoughness":{"metallicFactor":1.5,
      "roughnessFactor":-1,"baseColorFactor":[1,1,2,1]},"alphaMode":"DITHER","extensions":{"KHR_materials_ior":{"ior":0.5},
      "KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":0}}})"));
  const Material& material = loaded.scene.materials.at(0);
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 0);
  EXPECT_EQ(material.base_color, Vec4(1));
  EXPECT_EQ(material.ior, 1);
  EXPECT_EQ(material.attenuation_distance, infinity);
  ASSERT_EQ(loaded.warnings.size(), 6u);
  EXPECT_EQ(loaded.warnings[1], "materials[0].pbrMetallicRoughness.metallicFactor: 1.5 is out of range, 1 is used");
  EXPECT_EQ(load_material(R"({"extensions":{"KHR_materials_ior":{"ior":0}}})").ior, 0) << "stands for infinity";
}

// Rotation of a quarter, counter-clockwise as seen in the image: what is looked up for (u, v) is u' = 2 v + 0.1 and
// v' = -3 u + 0.2 with cos = 0, sin = 1, scale (3, 2), offset (0.1, 0.2). The sample model TextureTransformTest
// fixes the sense of rotation: its arrow, at 45 degrees in the image, is turned by 22.5 degrees onto the marker at (u,
// v) = (0.421, 1.016), which is at 67.5 degrees; the lookup turns back.
TEST(GltfMaterial, AppliesTextureTransforms) {
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
TEST(GltfMaterial, AppliesTextureTransformsToEverySlot) {
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

TEST(GltfMaterial, IgnoresUvSetsBeyondTwo) {
  const LoadedScene loaded =
      load_sample(sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":2}}})"));
  EXPECT_FALSE(loaded.scene.materials.at(0).base_color_texture.is_used());
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(loaded.warnings[0],
            "materials[0].pbrMetallicRoughness.baseColorTexture: uses TEXCOORD_2, only 0 and 1 are "
            "supported; it is ignored");
}

TEST(GltfMaterial, WarnsOfUvsThatAreMissing) {
  GltfSample sample = sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})");
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]})"};
  const LoadedScene loaded = load_sample(sample);
  EXPECT_EQ(loaded.warnings,
            std::vector<std::string>{"meshes[0].primitives[0]: has no TEXCOORD_1 for the textures of its material"});
}

TEST(GltfMaterial, SamplersAndSharedImages) {
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

TEST(GltfMaterial, DecodesImagesInBufferViews) {
  GltfSample sample = sample_with_material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const int view = sample.add_view(from_base64(png_rgba8));
  sample.images = {"{\"name\":\"packed\",\"mimeType\":\"image/png\",\"bufferView\":" + std::to_string(view) + "}"};
  const Scene scene = load_sample(sample).scene;
  EXPECT_EQ(scene.images.at(0).name, "packed");
  EXPECT_EQ(scene.images[0].rgba8.at(1), glm::u8vec4(10, 20, 30, 0));
}

// A WebP image that cannot be decoded (here since it is none) is replaced by the texture's own source.
TEST(GltfMaterial, WebpFallsBackToTheCoreImage) {
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
TEST(GltfMaterial, TakesTheFirstImageThatCanBeDecoded) {
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

TEST(GltfMaterial, NormalTexturesGetTangents) {
  GltfSample sample = sample_with_material(R"({"normalTexture":{"index":0}})");
  const Mesh mesh = load_sample(sample).scene.meshes.at(0);
  // u grows along +X and v along +Y, mirrored with respect to an image's "up".
  EXPECT_EQ(mesh.tangents.at(0), Vec4(1, 0, 0, -1));
  sample.materials[0] = "{}";
  EXPECT_TRUE(load_sample(sample).scene.meshes.at(0).tangents.empty());
}

// An experiment is off unless a person turns it on: then it is read, and a file may require it.
TEST(GltfMaterial, ExperimentsHaveToBeTurnedOn) {
  const std::string name = "KHR_materials_volume_scatter";
  GltfSample sample = sample_with_material("{\"extensions\":{\"" + name + "\":{\"multiscatterColor\":[0.5,0.5,0.5]}}}");
  sample.root = ",\"extensionsUsed\":[\"" + name + "\"]";
  const LoadedScene off = load_sample(sample), on = load_sample(sample, all_extensions);
  EXPECT_EQ(off.extensions_unsupported, std::vector<std::string>{name});
  EXPECT_TRUE(is_black(off.scene.materials.at(0).extensions->multiscatter_color));
  EXPECT_TRUE(on.extensions_unsupported.empty());
  EXPECT_TRUE(on.not_honoured.empty());
  EXPECT_EQ(on.scene.materials.at(0).extensions->multiscatter_color, Vec3(0.5f));
  sample.root += ",\"extensionsRequired\":[\"" + name + "\"]";
  EXPECT_NE(load_error(sample).find(name), std::string::npos);
  EXPECT_NO_THROW(load_sample(sample, all_extensions));
}

}  // namespace
}  // namespace candil::test
