/// Textures of JSON scenes, and height images as normal maps.
#include <gtest/gtest.h>

#include "core/texture.h"
#include "io/bump_map.h"
#include "tests/io/json_sample.h"

namespace candil::test {
namespace {

/// The linear colour that the only material shows at (u, v).
Vec3 color_at(const Scene& scene, float u, float v) {
  const Vec2 uv[2] = {{u, v}, {0, 0}};
  return Vec3(sample_texture(scene, scene.materials.at(0).base_color_texture, uv, ColorSpace::srgb));
}

Scene textured(const TemporaryFolder& folder, const std::string& texture) {
  return load_json(folder, R"({"textures": {"t": )" + texture + R"(}, "objects": [{"type": "sphere",
    "center": [0, 0, 0], "radius": 1, "material": {"type": "lambertian", "kd": {"texture": "t"}}}]})")
      .scene;
}

TEST(JsonTexture, CheckerboardIsLinearAndRepeats) {
  const Scene scene = textured(TemporaryFolder(), R"({"checkerboard": [[0.5, 0.25, 1], 0.125], "repeat": [2, 1]})");
  // Two repeats along u: squares are 1/4 wide and 1/2 high.
  EXPECT_NEAR(color_at(scene, 0.1f, 0.1f).x, 0.5f, 1e-5f);
  EXPECT_NEAR(color_at(scene, 0.1f, 0.1f).y, 0.25f, 1e-5f);
  EXPECT_NEAR(color_at(scene, 0.3f, 0.1f).x, 0.125f, 1e-5f);
  EXPECT_NEAR(color_at(scene, 0.1f, 0.6f).x, 0.125f, 1e-5f);
  EXPECT_NEAR(color_at(scene, 0.6f, 0.1f).x, 0.5f, 1e-5f);
  EXPECT_NEAR(color_at(scene, -0.1f, 0.1f).x, 0.125f, 1e-5f);
}

// Roughness 0.5 is 0.5 in the texture as well.
TEST(JsonTexture, CheckerboardsOfDataAreStoredAsTheyAre) {
  const Scene scene = load_json(R"({"textures": {"t": {"checkerboard": [0.5, 0]}}, "objects": [{"type": "sphere",
      "center": [0, 0, 0], "radius": 1,
      "material": {"type": "metallic-roughness", "metallic_roughness_texture": "t"}}]})")
                          .scene;
  const Vec2 uv[2] = {{0.25f, 0.25f}, {0, 0}};
  EXPECT_EQ(sample_texture(scene, scene.materials.at(0).metallic_roughness_texture, uv, ColorSpace::linear).y, 0.5f);
}

// Value 188 of 255: as sRGB about 0.5029 linear, ((188/255 + 0.055) / 1.055)^2.4; as linear 0.7373.
TEST(JsonTexture, ColorSpace) {
  const TemporaryFolder folder;
  write_grey_png(folder / "grey.png", 2, 1, {188, 188});
  EXPECT_NEAR(color_at(textured(folder, R"({"image": "grey.png"})"), 0.5f, 0.5f).x, 0.5029f, 2e-4f);
  EXPECT_NEAR(color_at(textured(folder, R"({"image": "grey.png", "color_space": "linear"})"), 0.5f, 0.5f).x,
              188.0f / 255, 1e-5f);
}

TEST(JsonTexture, WrapFilterAndOffset) {
  const TemporaryFolder folder;
  write_grey_png(folder / "two.png", 2, 1, {0, 255});
  const Scene clamped =
      textured(folder, R"({"image": "two.png", "wrap": "clamp", "filter": "nearest", "offset": [0.5, 0]})");
  EXPECT_EQ(color_at(clamped, 0.25f, 0.5f).x, 1);   // looks up 0.75
  EXPECT_EQ(color_at(clamped, -0.25f, 0.5f).x, 0);  // 0.25
  EXPECT_EQ(color_at(clamped, 0.9f, 0.5f).x, 1);    // 1.4, clamped
  EXPECT_EQ(color_at(textured(folder, R"({"image": "two.png", "wrap": "mirror", "filter": "nearest"})"), 1.75f, 0.5f).x,
            0);
}

TEST(JsonTexture, UnusedImagesAreNotOpened) {
  const LoadedScene loaded = load_json(R"({"textures": {"t": {"image": "missing.png"}}})");
  EXPECT_TRUE(loaded.scene.images.empty());
  EXPECT_EQ(json_error(R"({"textures": {"t": {"image": "missing.png"}}, "objects": [{"type": "sphere",
    "center": [0, 0, 0], "radius": 1, "material": {"type": "mirror", "ks": {"texture": "t"}}}]})"),
            "scene.json: textures.t.image: \"missing.png\" does not exist");
}

// A ramp that rises by `height` over the width has the slope `height`: its normal is (-height, 0, 1) normalised.
TEST(BumpMap, RampTiltsAgainstItsSlope) {
  TextureImage ramp;
  ramp.width = 8, ramp.height = 2;
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 8; ++x) ramp.rgba32.emplace_back(Vec3((x + 0.5f) / 8), 1.0f);
  const TextureImage normals = normal_map_from_heights(ramp, 0.5f, Wrap::clamp);
  const Vec3 normal = 2.0f * Vec3(normals.rgba32.at(3)) - 1.0f, expected = glm::normalize(Vec3(-0.5f, 0, 1));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(normal[i], expected[i], 1e-6f);
}

// Rows go down, +Y up: a surface that rises from row to row leans up. Rows are 1 / width apart, as columns are.
TEST(BumpMap, RowsGoDownAndEdgesWrap) {
  TextureImage rows;
  rows.width = 4, rows.height = 3;
  for (const int value : {0, 51, 102})
    for (int x = 0; x < 4; ++x) rows.rgba8.emplace_back(value, value, value, 255);
  const TextureImage normals = normal_map_from_heights(rows, 1, Wrap::repeat);
  const auto normal = [&](std::size_t row) { return 2.0f * Vec3(normals.rgba32.at(row * 4)) - 1.0f; };
  // Middle row: 0.4 over two rows of 1/4: slope 0.8 downwards.
  const Vec3 expected = glm::normalize(Vec3(0, 0.8f, 1));
  EXPECT_NEAR(normal(1).y, expected.y, 1e-5f);
  // First row: its neighbours are 0.4 above (wrapped) and 0.2 below: slope (0.2 - 0.4) / 0.5 = -0.4 downwards.
  EXPECT_NEAR(normal(0).y, glm::normalize(Vec3(0, -0.4f, 1)).y, 1e-5f);
}

TEST(BumpMap, GivesMeshesTangents) {
  const TemporaryFolder folder;
  write_grey_png(folder / "bumps.png", 2, 2, {0, 255, 255, 0});
  const Scene scene = load_json(folder, R"({"textures": {"b": {"image": "bumps.png"}}, "objects": [{"type": "quad",
    "corners": [[0, 1, 0], [1, 1, 0], [0, 0, 0]],
    "material": {"type": "lambertian", "bump_map": {"texture": "b", "height": 0.1}}}]})")
                          .scene;
  ASSERT_EQ(scene.meshes.size(), 1U);
  ASSERT_FALSE(scene.meshes[0].tangents.empty());
  EXPECT_NEAR(scene.meshes[0].tangents[0].x, 1, 1e-6f);  // u grows along +X
  EXPECT_TRUE(scene.materials[0].normal_texture.is_used());
}

}  // namespace
}  // namespace candil::test
