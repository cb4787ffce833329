#include "core/texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/color.h"

namespace candil {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A float image of one row or more, its red channel given.
class Lookup {
 public:
  Lookup(int width, int height, std::vector<float> red, Wrap wrap, Filter filter) {
    TextureImage image;
    image.width = width, image.height = height;
    for (const float r : red) image.rgba32.emplace_back(r, 0, 0, 1);
    scene_.images = {image};
    scene_.textures = {{0, wrap, wrap, filter}};
    slot_.texture = 0;
  }
  float operator()(float u, float v) const {
    const Vec2 uv[2] = {{u, v}, Vec2(0)};
    return sample_texture(scene_, slot_, uv, ColorSpace::linear).x;
  }

 private:
  Scene scene_;
  TextureSlot slot_;
};

constexpr std::array all_wraps = {Wrap::repeat, Wrap::clamp, Wrap::mirror};

TEST(Texture, TexelCentresAreExactForBothFilters) {
  const std::vector<float> red = {1, 2, 3, 4, 50, 60, 70, 80};
  for (const Wrap wrap : all_wraps) {
    for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
      const Lookup lookup(4, 2, red, wrap, filter);
      for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 4; ++x) {
          EXPECT_EQ(lookup((static_cast<float>(x) + 0.5f) / 4, (static_cast<float>(y) + 0.5f) / 2), red[4 * y + x]);
        }
      }
    }
  }
}

// (0, 0) is the upper left corner of the image (glTF 2.0, section 3.8.2).
TEST(Texture, OriginIsTheUpperLeftCorner) {
  const Lookup lookup(2, 2, {1, 2, 3, 4}, Wrap::clamp, Filter::bilinear);
  EXPECT_EQ(lookup(0, 0), 1);
  EXPECT_EQ(lookup(1, 0), 2);
  EXPECT_EQ(lookup(0, 1), 3);
  EXPECT_EQ(lookup(1, 1), 4);
  EXPECT_EQ(lookup(0.5f, 0.5f), 2.5f);
}

// Texels 0 and 8, centres at 0.25 and 0.75: linear between, and what is beyond depends on the wrap mode.
TEST(Texture, BilinearAtTheBorders) {
  const Lookup repeat(2, 1, {0, 8}, Wrap::repeat, Filter::bilinear);
  const Lookup clamp(2, 1, {0, 8}, Wrap::clamp, Filter::bilinear);
  const Lookup mirror(2, 1, {0, 8}, Wrap::mirror, Filter::bilinear);
  for (const Lookup* lookup : {&repeat, &clamp, &mirror}) {
    EXPECT_FLOAT_EQ((*lookup)(0.375f, 0.5f), 2);
    EXPECT_FLOAT_EQ((*lookup)(0.5f, 0.5f), 4);
  }
  // At u = 0 and 1 the neighbours are the last and the first texel, or the border texel twice.
  EXPECT_FLOAT_EQ(repeat(0, 0.5f), 4);
  EXPECT_FLOAT_EQ(repeat(1, 0.5f), 4);
  EXPECT_FLOAT_EQ(repeat(0.125f, 0.5f), 2);
  EXPECT_FLOAT_EQ(repeat(-0.125f, 0.5f), 6);
  for (const Lookup* lookup : {&clamp, &mirror}) {
    EXPECT_FLOAT_EQ((*lookup)(0, 0.5f), 0);
    EXPECT_FLOAT_EQ((*lookup)(0.125f, 0.5f), 0);
    EXPECT_FLOAT_EQ((*lookup)(1, 0.5f), 8);
  }
  EXPECT_FLOAT_EQ(clamp(-3, 0.5f), 0);
  EXPECT_FLOAT_EQ(clamp(7, 0.5f), 8);
}

TEST(Texture, RepeatHasPeriodOne) {
  for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
    const Lookup lookup(3, 1, {1, 5, 11}, Wrap::repeat, filter);
    for (const float u : {0.1f, 0.45f, 0.8f, 0.95f}) {
      for (const float turns : {-7.0f, -1.0f, 1.0f, 32.0f}) {
        EXPECT_NEAR(lookup(u + turns, 0.5f), lookup(u, 0.5f), 1e-3f) << u << " + " << turns;
      }
    }
  }
}

TEST(Texture, MirrorIsEvenWithPeriodTwo) {
  for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
    const Lookup lookup(3, 1, {1, 5, 11}, Wrap::mirror, filter);
    for (const float u : {0.1f, 0.45f, 0.8f, 0.95f}) {
      EXPECT_NEAR(lookup(-u, 0.5f), lookup(u, 0.5f), 1e-4f);
      EXPECT_NEAR(lookup(2 - u, 0.5f), lookup(u, 0.5f), 1e-4f);
      EXPECT_NEAR(lookup(u + 2, 0.5f), lookup(u, 0.5f), 1e-4f);
      EXPECT_NEAR(lookup(u - 6, 0.5f), lookup(u, 0.5f), 1e-4f);
    }
  }
}

TEST(Texture, NearestTakesTheTexelThatHoldsThePoint) {
  const Lookup lookup(4, 1, {1, 2, 3, 4}, Wrap::clamp, Filter::nearest);
  EXPECT_EQ(lookup(0, 0.5f), 1);
  EXPECT_EQ(lookup(0.2499f, 0.5f), 1);
  EXPECT_EQ(lookup(0.2501f, 0.5f), 2);
  EXPECT_EQ(lookup(0.9999f, 0.5f), 4);
  EXPECT_EQ(lookup(1, 0.5f), 4);
}

// Continuous everywhere, also across the borders of the unit square.
TEST(Texture, BilinearHasNoSteps) {
  for (const Wrap wrap : all_wraps) {
    const Lookup lookup(5, 3, {0, 1, 0, 1, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0}, wrap, Filter::bilinear);
    float before = lookup(-2, -1.3f);
    for (int i = 1; i <= 40000; ++i) {
      const float along = 1e-4f * static_cast<float>(i);
      const float here = lookup(-2 + along, -1.3f + 0.7f * along);
      // Slopes are at most 5 and 3 per unit: 5e-4 + 2.1e-4 a step, and rounding of u times 5.
      ASSERT_NEAR(here, before, 8e-4f) << "at " << along;
      before = here;
    }
  }
}

TEST(Texture, NonFiniteAndHugeCoordinatesGiveATexel) {
  for (const Wrap wrap : all_wraps) {
    for (const Filter filter : {Filter::nearest, Filter::bilinear}) {
      const Lookup lookup(3, 2, {1, 2, 3, 4, 5, 6}, wrap, filter);
      for (const float bad : {nan, infinity, -infinity, 3e38f, -3e38f, 1e10f, -1e-30f}) {
        for (const float other : {0.4f, bad}) {
          for (const float value : {lookup(bad, other), lookup(other, bad)}) {
            EXPECT_GE(value, 1) << bad;
            EXPECT_LE(value, 6) << bad;
          }
        }
      }
    }
  }
}

TEST(Texture, OneTexelIsConstant) {
  for (const Wrap wrap : all_wraps) {
    const Lookup lookup(1, 1, {7}, wrap, Filter::bilinear);
    for (const float u : {-1.3f, 0.0f, 0.2f, 0.5f, 1.0f, 9.9f}) EXPECT_FLOAT_EQ(lookup(u, -u), 7);
  }
}

// Colours are decoded before they are mixed; alpha is linear. IEC 61966-2-1: byte 188 is 0.502887 linear; halfway
// between black and white is 0.5 of the light, not byte 128.
TEST(Texture, SrgbIsDecodedBeforeFiltering) {
  Scene scene;
  TextureImage image;
  image.width = 2, image.height = 1;
  image.rgba8 = {{0, 188, 255, 51}, {255, 188, 0, 102}};
  scene.images = {image};
  scene.textures = {{0, Wrap::clamp, Wrap::clamp, Filter::bilinear}};
  TextureSlot slot;
  slot.texture = 0;
  const Vec2 middle[2] = {Vec2(0.5f), Vec2(0)}, left[2] = {Vec2(0.25f, 0.5f), Vec2(0)};
  const Vec4 srgb = sample_texture(scene, slot, middle, ColorSpace::srgb);
  EXPECT_NEAR(srgb.x, 0.5f, 1e-6f);
  EXPECT_NEAR(srgb.y, 0.502887f, 1e-5f);
  EXPECT_NEAR(srgb.z, 0.5f, 1e-6f);
  EXPECT_NEAR(srgb.w, 0.3f, 1e-6f);
  const Vec4 linear = sample_texture(scene, slot, left, ColorSpace::linear);
  EXPECT_EQ(linear.x, 0);
  EXPECT_NEAR(linear.y, 188 / 255.0f, 1e-6f);
  EXPECT_NEAR(linear.w, 0.2f, 1e-6f);
}

// The same picture as floats gives the same light.
TEST(Texture, BytesAndFloatsAgree) {
  Scene scene;
  TextureImage bytes, floats;
  bytes.width = floats.width = 16, bytes.height = floats.height = 16;
  for (int i = 0; i < 256; ++i) {
    bytes.rgba8.emplace_back(i, 255 - i, i / 2, 255 - i / 3);
    floats.rgba32.push_back(Vec4(bytes.rgba8.back()) / 255.0f);
  }
  scene.images = {bytes, floats};
  scene.textures = {{0}, {1}};
  TextureSlot first, second;
  first.texture = 0, second.texture = 1;
  for (const ColorSpace space : {ColorSpace::linear, ColorSpace::srgb}) {
    for (int i = 0; i < 500; ++i) {
      const float t = static_cast<float>(i) * 0.0137f;
      const Vec2 uv[2] = {{t, 3 * t}, Vec2(0)};
      const Vec4 a = sample_texture(scene, first, uv, space), b = sample_texture(scene, second, uv, space);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(a[c], b[c], 1e-6f);
    }
  }
}

TEST(Texture, TransformAndUvSetAreUsed) {
  Scene scene;
  TextureImage image;
  image.width = 4, image.height = 1;
  for (int i = 1; i <= 4; ++i) image.rgba32.emplace_back(i, 0, 0, 1);
  scene.images = {image};
  scene.textures = {{0, Wrap::clamp, Wrap::clamp, Filter::nearest}};
  TextureSlot slot;
  slot.texture = 0;
  slot.uv_set = 1;
  slot.row_u = Vec3(0, 0.5f, 0.25f);  // u = v / 2 + 1/4
  slot.row_v = Vec3(1, 0, 0);
  const Vec2 uv[2] = {Vec2(0.9f), Vec2(0.1f, 0.6f)};  // u = 0.55: third texel
  EXPECT_EQ(sample_texture(scene, slot, uv, ColorSpace::linear).x, 3);
}

}  // namespace
}  // namespace candil
