// KHR_materials_variants: a choice of materials for the whole file.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/error.h"
#include "tests/support/gltf/gltf_sample.h"

namespace candil::test {
namespace {

/// Mesh 0: a primitive with material 0, mapped to 1 in variant 0 and to 2 in variant 1 and 2. Mesh 1: a primitive with
/// material 0, mapped in variant 1 alone. Node 2 shows mesh 0 again.
GltfSample sample_with_variants() {
  GltfSample sample;
  sample.add_triangle("", R"(,"material":0,"extensions":{"KHR_materials_variants":{"mappings":[
      {"material":1,"variants":[0]},{"material":2,"variants":[1,2],"name":"late"}]}})");
  sample.add_triangle("", R"(,"material":0,"extensions":{"KHR_materials_variants":{"mappings":[
      {"material":2,"variants":[1]}]}})");
  sample.nodes.push_back(R"({"mesh":0,"translation":[5,0,0]})");
  sample.materials = {R"({"name":"plain"})", R"({"name":"red"})", R"({"name":"green"})"};
  sample.root = R"(,"extensions":{"KHR_materials_variants":{"variants":[{"name":"Morning"},{"name":"Noon"},
      {"name":"0"}]}})";
  return sample;
}

/// The name of each mesh's material.
std::vector<std::string> materials_of(const LoadOptions& options) {
  const Scene scene = load_sample(sample_with_variants(), options).scene;
  EXPECT_EQ(scene.meshes.size(), 2u) << "a mesh that two nodes show is there once";
  EXPECT_EQ(scene.instances.size(), 3u);
  std::vector<std::string> names;
  for (const Mesh& mesh : scene.meshes) names.push_back(scene.materials[mesh.material].name);
  return names;
}

LoadOptions variant(const std::string& choice) {
  LoadOptions options;
  options.variant = choice;
  return options;
}

TEST(GltfVariant, MapsPrimitives) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(materials_of({}), (Names{"plain", "plain"}));
  EXPECT_EQ(materials_of(variant("Morning")), (Names{"red", "plain"})) << "not mapped: the primitive's own material";
  EXPECT_EQ(materials_of(variant("1")), (Names{"green", "green"}));
  EXPECT_EQ(materials_of(variant("0")), (Names{"green", "plain"})) << "names go before indices";
}

TEST(GltfVariant, UnknownOnesNameThoseThatAreThere) {
  try {
    load_sample(sample_with_variants(), variant("Night"));
    FAIL() << "loaded";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("model.gltf: variants: there is no variant \"Night\"; there are: 0 \"Morning\", 1 \"Noon\", "
                           "2 \"0\""),
              std::string::npos)
        << message;
  }
  GltfSample plain;
  plain.add_triangle();
  EXPECT_THROW(load_sample(plain, variant("0")), InputError);
}

TEST(GltfVariant, AreListed) {
  EXPECT_EQ(load_sample(sample_with_variants()).contents.variants, (std::vector<std::string>{"Morning", "Noon", "0"}));
}

TEST(GltfVariant, DamageIsFound) {
  const auto error_with = [](const std::string& from, const std::string& to) {
    std::string text = sample_with_variants().json();
    text.replace(text.find(from), from.size(), to);
    return load_error(text);
  };
  const std::string place = "model.gltf: meshes[0].primitives[0].extensions.KHR_materials_variants.mappings[0].";
  EXPECT_EQ(error_with(R"("material":1,)", R"("material":3,)"),
            place + "material: index 3 does not exist: there are 3 in materials");
  EXPECT_EQ(error_with(R"("variants":[0])", R"("variants":[9])"),
            place + "variants[0]: index 9 does not exist: there are 3 in variants");
  EXPECT_EQ(error_with(R"("material":1,)", ""), place + "material: is missing");
  EXPECT_EQ(error_with(R"({"name":"Noon"})", R"({})"),
            "model.gltf: extensions.KHR_materials_variants.variants[1].name: is missing");
}

TEST(GltfVariant, TheFirstOfTwoMappingsCounts) {
  std::string text = sample_with_variants().json();
  const std::string from = R"("variants":[1,2])";
  text.replace(text.find(from), from.size(), R"("variants":[0])");
  const LoadedScene loaded = load_text(text, variant("Morning"));
  EXPECT_EQ(loaded.scene.materials.at(loaded.scene.meshes.at(0).material).name, "red");
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_EQ(
      loaded.warnings[0],
      "meshes[0].primitives[0].extensions.KHR_materials_variants.mappings: map variant 0 more than once, the first "
      "mapping is used");
}

}  // namespace
}  // namespace candil::test
