#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "io/error.h"
#include "tests/io/material_sample.h"

namespace candil::test {
namespace {

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

// By the texts of the others, none of which forbids KHR_materials_emissive_strength beside specular-glossiness.
TEST(GltfMaterial, WarnsOfExtensionsThatAnotherExcludes) {
  const auto warnings_with = [](const std::string& extensions) {
    GltfSample sample;
    sample.materials = {"{\"extensions\":{" + extensions + "}}"};
    sample.add_triangle("", ",\"material\":0");
    return load_sample(sample).warnings;
  };
  const std::string gloss = "\"KHR_materials_pbrSpecularGlossiness\":{}", unlit = "\"KHR_materials_unlit\":{}",
                    ior = ",\"KHR_materials_ior\":{}", sheen = ",\"KHR_materials_sheen\":{}";
  EXPECT_EQ(warnings_with(gloss + ior),
            std::vector<std::string>{"materials[0].extensions: KHR_materials_ior does not go with "
                                     "KHR_materials_pbrSpecularGlossiness, which alone is used"});
  EXPECT_EQ(warnings_with(unlit + ior + sheen),
            std::vector<std::string>{"materials[0].extensions: KHR_materials_ior, KHR_materials_sheen do not go with "
                                     "KHR_materials_unlit, which alone is used"});
  EXPECT_TRUE(warnings_with(gloss + ",\"KHR_materials_emissive_strength\":{}").empty());
  EXPECT_TRUE(warnings_with(unlit + "," + gloss).empty()) << "a fallback for readers without KHR_materials_unlit";
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
