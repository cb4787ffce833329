/// Textures of JSON scenes, and height images as normal maps.
#include <gtest/gtest.h>

#include "core/texture.h"
#include "io/bump_map.h"
#include "io/image_file.h"
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

/// The normal at (u, v) of the surface that a texture of bumps, or of the normals that they make, gives.
Vec3 mapped_normal(const TemporaryFolder& folder, const std::string& transform, const std::string& map, Vec2 at) {
  const Scene scene = load_json(folder, R"({"textures": {"t": {)" + transform + R"(}}, "objects": [{"type": "sphere",
    "center": [0, 0, 0], "radius": 1, "material": {"type": "lambertian", )" +
                                            map + "}}]}")
                          .scene;
  const Vec2 uv[2] = {at, {0, 0}};
  return 2.0f * Vec3(sample_texture(scene, scene.materials.at(0).normal_texture, uv, ColorSpace::linear)) - 1.0f;
}

// A ramp to the right: its normals lean to the left, (-x, 0). Looked up at (u', v') = R S (u, v), the height rises
// along the gradient S R^T (1, 0) in (u, v), v downwards. Rotation by 90 degrees has u' = v, v' = -u: it rises along v,
// down; the normal leans up. A repeat of -1 has u' = -u: it rises to the left.
TEST(BumpMap, TurnsWithItsImage) {
  const TemporaryFolder folder;
  write_grey_png(folder / "ramp.png", 5, 5, {0,   51,  102, 153, 204, 0,   51,  102, 153, 204, 0,   51, 102,
                                             153, 204, 0,   51,  102, 153, 204, 0,   51,  102, 153, 204});
  const std::string image = R"("image": "ramp.png")", map = R"("bump_map": {"texture": "t", "height": 1})";
  // 0.4 over two pixels of 1/5 is a slope of 1.
  const float lean = 1 / std::sqrt(2.0f);
  const auto expect_normal = [&](const std::string& transform, Vec2 at, Vec3 expected) {
    const Vec3 normal = mapped_normal(folder, image + transform, map, at);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(normal[i], expected[i], 1e-5f) << transform << " " << i;
  };
  expect_normal("", {0.5f, 0.5f}, {-lean, 0, lean});
  expect_normal(R"(, "rotation": 90)", {-0.5f, 0.5f}, {0, lean, lean});
  expect_normal(R"(, "rotation": -90)", {0.5f, -0.5f}, {0, -lean, lean});
  expect_normal(R"(, "repeat": [-1, 1])", {-0.5f, 0.5f}, {lean, 0, lean});
  expect_normal(R"(, "repeat": [-1, 1], "rotation": 180)", {0.5f, -0.5f}, {-lean, 0, lean});
}

// The stored normal (1, 0) of a normal map turns the same way; those of one image do not get mixed up.
TEST(NormalMap, TurnsWithItsImage) {
  const TemporaryFolder folder;
  Image image(1, 1, 3);
  image.pixels = {1, 0.5f, 0.5f};
  write_image(folder / "n.png", image, false, {});
  const std::string map = R"("normal_map": {"texture": "t"})";
  EXPECT_NEAR(mapped_normal(folder, R"("image": "n.png")", map, Vec2(0.5f)).x, 1, 1e-5f);
  const Vec3 turned = mapped_normal(folder, R"("image": "n.png", "rotation": 90)", map, Vec2(0.5f));
  EXPECT_NEAR(turned.x, 0, 0.01f);  // 0.5 is not a byte
  EXPECT_NEAR(turned.y, -1, 1e-5f);
  EXPECT_EQ(
      json_error(folder, R"({"textures": {"t": {"image": "n.png", "wrap": "mirror"}}, "objects": [{"type": "sphere",
    "center": [0, 0, 0], "radius": 1, "material": {"type": "mirror", "normal_map": {"texture": "t"}}}]})"),
      "scene.json: objects[0].material.normal_map.texture: must not be a texture with \"wrap\": \"mirror\", in "
      "which bumps would become dents");
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
