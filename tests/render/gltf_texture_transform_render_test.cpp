// KHR_texture_transform on every slot of a material beside texture coordinates that are transformed in the file.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "io/gltf_extensions.h"
#include "io/image_file.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

constexpr float angle = 0.5235988f;  // 30 degrees
constexpr const char* transform =
    R"("extensions":{"KHR_texture_transform":{"offset":[0.3,0.1],"rotation":0.5235988,"scale":[1.5,0.5]}})";

/// The transform above as the extension's sample models show it: scaled, turned counter-clockwise in the image (v
/// points down), moved.
Vec2 transformed(Vec2 uv) {
  const Vec2 s(1.5f * uv.x, 0.5f * uv.y);
  return {std::cos(angle) * s.x + std::sin(angle) * s.y + 0.3f, -std::sin(angle) * s.x + std::cos(angle) * s.y + 0.1f};
}

/// 4 x 4 texels whose four channels all vary, none like another.
std::string texture_uri() {
  Image image(4, 4, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>((37 * i + 11) % 64) / 63;
  return "data:image/png;base64," + to_base64(encode_png(image, true));
}

struct Slot {
  std::string name, extension;
  std::string before, after;  ///< Of the textureInfo, in the material's JSON.
};

void PrintTo(const Slot& slot, std::ostream* stream) { *stream << slot.name; }

/// Slot of an extension: the factors that it needs, and the property.
Slot slot_of(const std::string& extension, const std::string& factors, const std::string& property,
             const std::string& others = "") {
  return {property, extension,
          R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.4,0.3,1],"metallicFactor":0,"roughnessFactor":0.4},
             "extensions":{)" +
              others + "\"" + extension + "\":{" + factors + "\"" + property + "\":",
          "}}}"};
}

/// Radiance at places of a square of that material, under a sky and a lamp near the mirror direction; and behind it
/// another lamp, of another colour.
std::vector<Vec3> appearance(const Slot& slot, const std::string& texture_info, bool is_baked, bool has_tangents) {
  GltfSample sample;
  const std::array<Vec2, 4> uvs = {Vec2(0, 1), Vec2(1, 1), Vec2(1, 0), Vec2(0, 0)};
  std::vector<float> coordinates;
  for (const Vec2 uv : uvs) {
    const Vec2 t = is_baked ? transformed(uv) : uv;
    coordinates.insert(coordinates.end(), {t.x, t.y});
  }
  sample.add_accessor<float>(gl_float, "VEC3", 4, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
  sample.add_accessor<float>(gl_float, "VEC2", 4, coordinates);
  sample.add_accessor<std::uint16_t>(gl_unsigned_short, "SCALAR", 6, {0, 1, 2, 0, 2, 3});
  sample.add_accessor<float>(gl_float, "VEC4", 4, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
  sample.add_accessor<float>(gl_float, "VEC3", 4, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  sample.add_triangle(std::string(",\"NORMAL\":4,\"TEXCOORD_0\":1") + (has_tangents ? ",\"TANGENT\":3" : ""),
                      ",\"indices\":2,\"material\":0");
  sample.materials = {slot.before + texture_info + slot.after};
  sample.textures = {R"({"source":0})"};
  sample.images = {"{\"uri\":\"" + texture_uri() + "\"}"};
  LoadedScene loaded = load_sample(sample);
  for (const std::string& warning : loaded.warnings) ADD_FAILURE() << warning;
  loaded.scene.environment.tint = Vec3(0.3f);
  PunctualLight lamp;
  lamp.position = Vec3(1.5f, 0.5f, 2), lamp.intensity = Vec3(4);
  PunctualLight lamp_behind;
  lamp_behind.position = Vec3(0.5f, 0, -1), lamp_behind.intensity = Vec3(5, 1, 1);
  loaded.scene.punctual_lights = {lamp, lamp_behind};
  const Stage stage(std::move(loaded.scene));
  std::vector<Vec3> radiances;
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      const Vec3 from(-2, -0.3f, 2),
          to(-0.77f + 0.37f * static_cast<float>(x), -0.73f + 0.37f * static_cast<float>(y), 0);
      radiances.push_back(estimate_radiance(stage, trace_path, {from, glm::normalize(to - from)}, 16, 2).mean);
    }
  }
  return radiances;
}

/// How many places of the two differ by more than that share. Random choices between lobes may fall otherwise by
/// rounding, at a place or so.
std::size_t differences(const std::vector<Vec3>& a, const std::vector<Vec3>& b, float share) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float difference = max_component(glm::abs(a[i] - b[i]));
    count += difference > share * max_component(b[i]) ? 1 : 0;
  }
  return count;
}

class TextureTransform : public testing::TestWithParam<Slot> {};

TEST_P(TextureTransform, EqualsTransformedCoordinates) {
  const Slot& slot = GetParam();
  const std::string plain = R"({"index":0})", with_transform = std::string(R"({"index":0,)") + transform + "}";
  for (const bool has_tangents : {true, false}) {
    const std::vector<Vec3> expected = appearance(slot, plain, true, has_tangents);
    EXPECT_LE(differences(appearance(slot, with_transform, false, has_tangents), expected, 1e-3f), 2u)
        << (has_tangents ? "with" : "without") << " tangents in the file";
    EXPECT_GE(differences(appearance(slot, plain, false, has_tangents), expected, 3e-3f), 6u)
        << "the texture shows nothing, this test tells nothing";
  }
}

/// Those that this build renders.
std::vector<Slot> slots() {
  const std::string rough = R"("metallicFactor":0.5,"roughnessFactor":0.5,)";
  std::vector<Slot> all = {
      {"baseColorTexture", "", R"({"pbrMetallicRoughness":{)" + rough + R"("baseColorTexture":)", "}}"},
      {"metallicRoughnessTexture", "", R"({"pbrMetallicRoughness":{"metallicRoughnessTexture":)", "}}"},
      {"normalTexture", "", R"({"pbrMetallicRoughness":{)" + rough + R"("baseColorFactor":[0.5,0.5,0.5,1]},
         "normalTexture":)",
       "}"},
      {"emissiveTexture", "", R"({"emissiveFactor":[1,1,1],"emissiveTexture":)", "}"},
      slot_of("KHR_materials_specular", "", "specularTexture", R"("KHR_materials_ior":{"ior":2.5},)"),
      slot_of("KHR_materials_specular", "", "specularColorTexture", R"("KHR_materials_ior":{"ior":2.5},)"),
      slot_of("KHR_materials_transmission", R"("transmissionFactor":1,)", "transmissionTexture"),
      slot_of("KHR_materials_clearcoat", R"("clearcoatFactor":1,"clearcoatRoughnessFactor":0.5,)", "clearcoatTexture"),
      slot_of("KHR_materials_clearcoat", R"("clearcoatFactor":1,"clearcoatRoughnessFactor":0.8,)",
              "clearcoatRoughnessTexture"),
      slot_of("KHR_materials_clearcoat", R"("clearcoatFactor":1,"clearcoatRoughnessFactor":0.5,)",
              "clearcoatNormalTexture"),
      slot_of("KHR_materials_sheen", R"("sheenColorFactor":[1,1,1],"sheenRoughnessFactor":0.5,)", "sheenColorTexture"),
      slot_of("KHR_materials_sheen", R"("sheenColorFactor":[1,1,1],"sheenRoughnessFactor":1,)",
              "sheenRoughnessTexture"),
      slot_of("KHR_materials_anisotropy", R"("anisotropyStrength":1,)", "anisotropyTexture",
              R"("KHR_materials_ior":{"ior":2.5},)"),
      slot_of("KHR_materials_iridescence", R"("iridescenceFactor":1,"iridescenceIor":2,)", "iridescenceTexture"),
      slot_of("KHR_materials_iridescence", R"("iridescenceFactor":1,"iridescenceIor":2,)",
              "iridescenceThicknessTexture"),
      slot_of("KHR_materials_diffuse_transmission", R"("diffuseTransmissionFactor":1,)", "diffuseTransmissionTexture"),
      slot_of("KHR_materials_diffuse_transmission", R"("diffuseTransmissionFactor":1,)",
              "diffuseTransmissionColorTexture"),
  };
  std::erase_if(
      all, [](const Slot& slot) { return !slot.extension.empty() && !is_supported_gltf_extension(slot.extension); });
  return all;
}

INSTANTIATE_TEST_SUITE_P(Slots, TextureTransform, testing::ValuesIn(slots()),
                         [](const auto& slot) { return slot.param.name; });

}  // namespace
}  // namespace candil::test
