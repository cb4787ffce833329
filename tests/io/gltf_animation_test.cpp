#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "io/error.h"
#include "io/scene_sequence.h"
#include "tests/io/image_samples.h"
#include "tests/support/expect_near.h"
#include "tests/support/gltf/animated_sample.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {
namespace {

std::string error_at(const std::string& text, const LoadOptions& options = options_at(0.5)) {
  try {
    load_text(text, options);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("model.gltf"));
  }
  return {};
}

// Corner 1 is at (1, 0, 0). At 1/2 s: scaled by 2, a quarter turn about Z half done, moved to (5, 0, 0).
TEST(GltfAnimation, MovesNodes) {
  AnimatedSample sample = movable_triangle();
  const float h = std::sqrt(0.5f);
  sample.move_node(0, "translation", "VEC3", {0, 1}, {0, 0, 0, 10, 0, 0});
  sample.move_node(0, "rotation", "VEC4", {0, 1}, {0, 0, 0, 1, 0, 0, h, h});
  sample.move_node(0, "scale", "VEC3", {0, 1}, {1, 1, 1, 3, 3, 3});
  const std::string text = sample.animated_json();
  const auto corner = [&](double seconds) {
    return load_text(text, options_at(seconds)).scene.meshes.at(0).positions.at(1);
  };
  expect_near(corner(0), {1, 0, 0});
  expect_near(corner(0.5), {5 + 2 * h, 2 * h, 0});
  expect_near(corner(1), {10, 3, 0});
  expect_near(corner(7), {10, 3, 0});
  expect_near(load_text(text).scene.meshes.at(0).positions.at(1), {1, 0, 0});  // rest pose
}

TEST(GltfAnimation, MovedMatricesAreTakenApart) {
  AnimatedSample sample = movable_triangle();
  // Scale (2, 3, 4), a quarter turn about Z, translation (5, 6, 7).
  sample.nodes = {R"({"mesh":0,"matrix":[0,2,0,0, -3,0,0,0, 0,0,4,0, 5,6,7,1]})"};
  sample.move_node(0, "translation", "VEC3", {0, 1}, {0, 0, 0, 2, 2, 2});
  const std::vector<Vec3> p = load_text(sample.animated_json(), options_at(1)).scene.meshes.at(0).positions;
  expect_near(p[0], {2, 2, 2});
  expect_near(p[1], {2, 4, 2});
  expect_near(p[2], {-1, 2, 2});
}

TEST(GltfAnimation, MovesWeightsOfMorphTargets) {
  AnimatedSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  sample.add_triangle("", ",\"targets\":[{\"POSITION\":1},{\"POSITION\":2}]");
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 8, 0, 0, 8, 0, 0, 8});
  sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 4, 0, 0, 4, 0, 0, 4, 0});
  AnimatedSample whole = sample, single = sample;
  // Two weights for each key: (0, 1), then (1, 0).
  whole.move_node(0, "weights", "SCALAR", {0, 1}, {0, 1, 1, 0});
  expect_near(load_text(whole.animated_json(), options_at(0.25)).scene.meshes.at(0).positions[0], {0, 3, 2});
  single.move("/nodes/0/weights/1", "SCALAR", {0, 1}, {0, 1});
  expect_near(load_text(single.animated_json(), options_at(0.25)).scene.meshes.at(0).positions[0], {0, 1, 0});
}

/// What a pointer moves at 1/4 s between two values, seen in the scene.
struct PointerCase {
  std::string name, pointer, type;
  std::vector<float> values;
  float (*look)(const Scene&);
  float expected;
};

const Material& material(const Scene& scene) { return scene.materials.at(scene.meshes.at(0).material); }

const std::vector<PointerCase> pointer_cases = {
    {"base_color",
     "/materials/0/pbrMetallicRoughness/baseColorFactor",
     "VEC4",
     {0, 0, 0, 1, 0, 1, 0, 1},
     [](const Scene& s) { return material(s).base_color.y; },
     0.25f},
    {"metallic",
     "/materials/0/pbrMetallicRoughness/metallicFactor",
     "SCALAR",
     {0, 1},
     [](const Scene& s) { return material(s).metallic; },
     0.25f},
    {"roughness",
     "/materials/0/pbrMetallicRoughness/roughnessFactor",
     "SCALAR",
     {1, 0},
     [](const Scene& s) { return material(s).roughness; },
     0.75f},
    {"emissive",
     "/materials/0/emissiveFactor",
     "VEC3",
     {0, 0, 0, 0, 0, 1},
     [](const Scene& s) { return material(s).emission.z; },
     0.25f},
    {"alpha_cutoff",
     "/materials/0/alphaCutoff",
     "SCALAR",
     {0, 1},
     [](const Scene& s) { return material(s).alpha_cutoff; },
     0.25f},
    {"ior",
     "/materials/0/extensions/KHR_materials_ior/ior",
     "SCALAR",
     {1, 2},
     [](const Scene& s) { return material(s).ior; },
     1.25f},
    {"transmission",
     "/materials/0/extensions/KHR_materials_transmission/transmissionFactor",
     "SCALAR",
     {0, 1},
     [](const Scene& s) { return material(s).transmission; },
     0.25f},
    {"attenuation",
     "/materials/0/extensions/KHR_materials_volume/attenuationColor",
     "VEC3",
     {0, 0, 0, 1, 1, 1},
     [](const Scene& s) { return material(s).attenuation_color.y; },
     0.25f},
    {"normal_scale",
     "/materials/0/normalTexture/scale",
     "SCALAR",
     {0, 1},
     [](const Scene& s) { return material(s).normal_scale; },
     0.25f},
    {"yfov",
     "/cameras/0/perspective/yfov",
     "SCALAR",
     {1, 2},
     [](const Scene& s) { return s.cameras.at(0).yfov; },
     1.25f},
    {"light_intensity",
     "/extensions/KHR_lights_punctual/lights/0/intensity",
     "SCALAR",
     {0, 100},
     [](const Scene& s) { return s.punctual_lights.at(0).intensity.x; },
     25},
    {"light_color",
     "/extensions/KHR_lights_punctual/lights/0/color",
     "VEC3",
     {0, 0, 0, 0, 1, 0},
     [](const Scene& s) { return s.punctual_lights.at(0).intensity.y; },
     0.25f},
    {"light_cone",
     "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle",
     "SCALAR",
     {0.5f, 1.5f},
     [](const Scene& s) { return s.punctual_lights.at(0).outer_cone; },
     0.75f},
    {"translation",
     "/nodes/0/translation",
     "VEC3",
     {0, 0, 0, 4, 0, 0},
     [](const Scene& s) { return s.meshes.at(0).positions.at(0).x; },
     1},
};

class GltfAnimationPointer : public testing::TestWithParam<PointerCase> {};

TEST_P(GltfAnimationPointer, MovesWhatItNames) {
  const PointerCase& each = GetParam();
  AnimatedSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.nodes.push_back(R"({"camera":0,"extensions":{"KHR_lights_punctual":{"light":0}}})");
  sample.images = {"{\"uri\":\"data:image/png;base64," + std::string(png_rgba8) + "\"}"};
  sample.textures = {R"({"source":0})"};
  sample.materials = {R"({"pbrMetallicRoughness":{},"normalTexture":{"index":0},"extensions":{"KHR_materials_ior":{},
      "KHR_materials_transmission":{},"KHR_materials_volume":{}}})"};
  sample.cameras = {R"({"type":"perspective","perspective":{"yfov":1,"znear":1}})"};
  sample.root = R"(,"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{"innerConeAngle":0.1}}]}})";
  sample.move(each.pointer, each.type, {0, 1}, each.values);
  const LoadedScene loaded = load_text(sample.animated_json(), options_at(0.25));
  EXPECT_NEAR(each.look(loaded.scene), each.expected, 1e-5f);
}

INSTANTIATE_TEST_SUITE_P(Kinds, GltfAnimationPointer, testing::ValuesIn(pointer_cases),
                         [](const auto& test) { return test.param.name; });

TEST(GltfAnimation, MovesTextureTransforms) {
  AnimatedSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.images = {"{\"uri\":\"data:image/png;base64," + std::string(png_rgba8) + "\"}"};
  sample.textures = {R"({"source":0})"};
  sample.materials = {R"({"emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":{}}}})"};
  sample.move("/materials/0/emissiveTexture/extensions/KHR_texture_transform/offset", "VEC2", {0, 1}, {0, 0, 4, 8});
  GltfSample still = sample;
  still.materials = {R"({"emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[1,2]}}}})"};
  const Scene moved = load_text(sample.animated_json(), options_at(0.25)).scene, expected = load_sample(still).scene;
  const auto look_up = [](const Scene& scene) {
    const TextureSlot& slot = material(scene).emission_texture;
    return std::pair(slot.row_u, slot.row_v);
  };
  EXPECT_EQ(look_up(moved), look_up(expected));
  EXPECT_NE(look_up(load_text(sample.animated_json(), options_at(0)).scene), look_up(expected));
}

TEST(GltfAnimation, MovesVisibilityByByteSteps) {
  AnimatedSample sample = movable_triangle();
  sample.nodes = {R"({"mesh":0,"extensions":{"KHR_node_visibility":{"visible":true}}})"};
  sample.move("/nodes/0/extensions/KHR_node_visibility/visible", "SCALAR", {0, 1, 2}, {1, 0, 1}, "STEP");
  const int bytes = sample.add_accessor<std::uint8_t>(gl_unsigned_byte, "SCALAR", 3, {1, 0, 7});
  sample.animation_samplers[0] = "{\"input\":1,\"interpolation\":\"STEP\",\"output\":" + std::to_string(bytes) + "}";
  for (const auto& [seconds, count] : {std::pair(0.5, 1u), std::pair(1.5, 0u), std::pair(2.0, 1u)}) {
    EXPECT_EQ(load_text(sample.animated_json(), options_at(seconds)).scene.instances.size(), count) << seconds;
  }
}

TEST(GltfAnimation, PointersToNothingAreLeftOutWithAWarning) {
  for (const char* pointer : {"/materials/0/emissiveFactor", "/nodes/0/matrix", "/nodes/0/mesh", "/nodes/1/scale",
                              "/nodes/00/scale", "/nodes", "/nodes/0/translation/0", "/nodes/0/extras/size",
                              "/nodes/0/weights", "/nodes/0/weights/0", "/accessors/0/max", "/meshes/0/weights", "",
                              "nodes/0/scale", "/nodes/0/extensions/KHR_node_visibility/visible", "/nodes/-1/scale"}) {
    AnimatedSample sample = movable_triangle();
    sample.move(pointer, "VEC3", {0, 1}, {0, 0, 0, 1, 1, 1});
    const LoadedScene loaded = load_text(sample.animated_json(), options_at(1));
    ASSERT_EQ(loaded.warnings.size(), 1u) << pointer;
    EXPECT_NE(loaded.warnings[0].find("nothing that can be moved"), std::string::npos) << loaded.warnings[0];
  }
}

TEST(GltfAnimation, IsChosenByIndexNameOrAll) {
  AnimatedSample right = movable_triangle(), up = movable_triangle();
  right.move_node(0, "translation", "VEC3", {0, 2}, {0, 0, 0, 4, 0, 0});
  up = right;
  up.channels.clear(), up.animation_samplers.clear();
  up.move_node(0, "scale", "VEC3", {0, 1}, {1, 1, 1, 3, 3, 3});
  up.root = ",\"animations\":[" + right.animation("right") + "," + up.animation("up") + "]";
  const std::string text = up.json();
  const auto corner = [&](const LoadOptions& options) {
    return load_text(text, options).scene.meshes.at(0).positions.at(1);
  };
  expect_near(corner(options_at(1)), {3, 0, 0});
  expect_near(corner(options_at(1, "1")), {3, 0, 0});
  expect_near(corner(options_at(1, "up")), {3, 0, 0});
  expect_near(corner(options_at(0.5, "up")), {2, 0, 0});
  expect_near(corner(options_at(0.5, "right")), {2, 0, 0});
  expect_near(corner(options_at(0.5, "all")), {3, 0, 0});
  LoadOptions start;
  start.animation = "right";
  expect_near(corner(start), {1, 0, 0});
  EXPECT_EQ(error_at(text, options_at(1, "down")),
            "model.gltf: animations: there is no animation \"down\"; there are: 0 \"right\", 1 \"up\"");
  EXPECT_EQ(error_at(movable_triangle().json()),
            "model.gltf: animations: there is no animation \"0\", the file has none");
  const LoadedScene loaded = load_text(text);
  ASSERT_EQ(loaded.animations.size(), 2u);
  EXPECT_EQ(loaded.animations[0].name, "right");
  EXPECT_EQ(loaded.animations[0].seconds, 2);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(GltfAnimation, RefusesKeysThatMakeNoCurve) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const auto error = [](const std::vector<float>& times, const std::vector<float>& values,
                        const std::string& type = "VEC3", const std::string& interpolation = "LINEAR") {
    AnimatedSample sample = movable_triangle();
    sample.move_node(0, "translation", type, times, values, interpolation);
    const std::string text = sample.animated_json();
    EXPECT_EQ(load_text(text).scene.instances.size(), 1u) << "the rest pose is there all the same";
    return error_at(text);
  };
  const std::string input = "model.gltf: animations[0].samplers[0].input: accessor 1 ",
                    output = "model.gltf: animations[0].samplers[0].output: accessor 2 ";
  EXPECT_EQ(error({0, 1, 0.5f}, {0, 0, 0, 0, 0, 0, 0, 0, 0}), input + "element 2 is earlier than the one before");
  EXPECT_EQ(error({0, nan}, {0, 0, 0, 0, 0, 0}), input + "element 1 is not finite");
  EXPECT_EQ(error({0, 1}, {0, 0, 0, 0, nan, 0}), output + "element 1 is not finite");
  EXPECT_EQ(error({0, 1}, {0, 0, 0}), output + "has 1 elements, 2 keys need 2");
  EXPECT_EQ(error({0, 1}, {0, 0, 0, 0, 0, 0}, "VEC3", "CUBICSPLINE"), output + "has 2 elements, 2 keys need 6");
  EXPECT_EQ(error({0, 1}, {0, 0, 0, 0, 0, 0, 0, 0}, "VEC4"), output + "must be of type VEC3 for /nodes/0/translation");
  EXPECT_EQ(error({0, 1}, {0, 0, 0, 0, 0, 0}, "VEC3", "BEZIER"),
            "model.gltf: animations[0].samplers[0].interpolation: \"BEZIER\" is none of: STEP LINEAR CUBICSPLINE");
  constexpr float huge = 3e38f;
  EXPECT_EQ(error({0, 1}, {0, 0, 0, huge, 0, 0, huge, 0, 0, -huge, 0, 0, huge, 0, 0, 0, 0, 0}, "VEC3", "CUBICSPLINE")
                .substr(0, 50),
            "model.gltf: animations[0].channels[0]: its spline ");
}

// A still of the rest pose needs no animation, however wrong its keys.
TEST(GltfAnimation, KeysOfIntegersAreRefusedOnlyWhenChosen) {
  AnimatedSample sample;
  sample.add_triangle();
  sample.move_node(0, "translation", "VEC3", {0, 1}, {0, 0, 0, 1, 0, 0});
  std::string& input = sample.accessors[1];
  input.replace(input.find("5126"), 4, "5125");
  EXPECT_EQ(load_text(sample.animated_json()).animations.at(0).seconds, 0);
  LoadOptions options;
  options.at = 0;
  try {
    load_text(sample.animated_json(), options);
    ADD_FAILURE() << "it was loaded";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("animations[0].samplers[0].input: accessor 1 must be SCALAR of floats"),
              std::string::npos)
        << error.what();
  }
}

TEST(GltfAnimation, RefusesReferencesToNothing) {
  AnimatedSample sample = movable_triangle();
  sample.move_node(0, "translation", "VEC3", {0, 1}, {0, 0, 0, 0, 0, 0});
  AnimatedSample bad = sample;
  bad.channels = {R"({"sampler":1,"target":{"node":0,"path":"scale"}})"};
  EXPECT_EQ(load_error(bad.animated_json()),
            "model.gltf: animations[0].channels[0].sampler: index 1 does not exist: there is 1 in samplers");
  bad.channels = {R"({"sampler":0,"target":{"node":1,"path":"scale"}})"};
  EXPECT_EQ(load_error(bad.animated_json()),
            "model.gltf: animations[0].channels[0].target.node: index 1 does not exist: there is 1 in nodes");
  bad.channels = {R"({"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{}}}})"};
  EXPECT_EQ(load_error(bad.animated_json()),
            "model.gltf: animations[0].channels[0].target.extensions.KHR_animation_pointer.pointer: is missing");
  bad.channels = {R"({"sampler":0,"target":{"path":"translation"}})"};  // no node: to be ignored
  EXPECT_TRUE(load_text(bad.animated_json(), options_at(1)).warnings.empty());
}

// Sixty-four million keys of zeros in a few characters of text.
TEST(GltfAnimation, RefusesKeysOutOfProportion) {
  AnimatedSample sample = movable_triangle();
  sample.accessors.push_back(R"({"componentType":5126,"type":"SCALAR","count":67108864})");
  sample.accessors.push_back(R"({"componentType":5126,"type":"VEC4","count":67108864})");
  sample.channels = {R"({"sampler":0,"target":{"node":0,"path":"rotation"}})"};
  sample.animation_samplers = {R"({"input":1,"output":2})"};
  EXPECT_NE(error_at(sample.animated_json()).find("the keys expand to far more"), std::string::npos);
}

}  // namespace
}  // namespace candil::test
