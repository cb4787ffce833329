// KHR_texture_basisu in the picture: every texel of a small KTX2 image is looked at by a ray of its own.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "core/color.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/gltf/ktx2_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// The square from (0, 0) to (1, 1), unlit, its image upright when seen from +Z: v points down.
Scene unlit_square(const std::string& texture, const std::vector<std::string>& images) {
  GltfSample sample;
  sample.add_accessor<float>(gl_float, "VEC3", 4, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                             R"(,"min":[0,0,0],"max":[1,1,0])");
  sample.add_accessor<float>(gl_float, "VEC2", 4, {0, 1, 1, 1, 1, 0, 0, 0});
  sample.add_accessor<std::uint16_t>(gl_unsigned_short, "SCALAR", 6, {0, 1, 2, 0, 2, 3});
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]})"};
  sample.nodes = {R"({"mesh":0})"};
  sample.materials = {
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"extensions":{"KHR_materials_unlit":{}}})"};
  sample.textures = {texture};
  sample.samplers = {R"({"magFilter":9728})"};
  sample.images = images;
  sample.root = R"(,"scene":0,"scenes":[{"nodes":[0]}],"extensionsUsed":["KHR_materials_unlit","KHR_texture_basisu"])";
  return load_sample(sample).scene;
}

std::string ktx2_image(const std::string& name) {
  return R"({"uri":"data:image/ktx2;base64,)" + to_base64(read_test_data(name)) + "\"}";
}

// An unlit surface emits its base colour, which is stored as sRGB: seen from the front, texel (x, y) shows at
// ((x + 0.5) / 16, 1 - (y + 0.5) / 16). No random number plays a part. What is left is the error of the coding, which
// is bounded as in ktx2_texture_test.cpp.
TEST(KtxTexture, ShowsItsTexelsWhereTheyBelong) {
  const std::string texture = R"({"source":1,"sampler":0,"extensions":{"KHR_texture_basisu":{"source":0}}})";
  const std::string core_image = R"({"uri":"nowhere.png"})";  // is not even opened while the first can be decoded
  struct Case {
    const char* name;
    double bound;
  };
  for (const Case& c : {Case{"etc1s.ktx2", 20}, Case{"uastc_linear.ktx2", 8}, Case{"uastc_zstd.ktx2", 8}}) {
#ifndef CANDIL_HAS_ZSTD
    if (c.name == std::string_view("uastc_zstd.ktx2")) continue;
#endif
    const Stage stage(unlit_square(texture, {ktx2_image(c.name), core_image}));
    double squares = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const Vec3 origin((x + 0.5f) / 16, 1 - (y + 0.5f) / 16, 1);
        const Vec3 radiance = estimate_radiance(stage, trace_path, {origin, Vec3(0, 0, -1)}, 1).mean;
        for (int i = 0; i < 3; ++i) {
          const float stored = 255 * linear_to_srgb(radiance[i]);
          squares += std::pow(stored - static_cast<float>(ktx2_sample_texel(x, y)[i]), 2);
        }
      }
    }
    EXPECT_LT(std::sqrt(squares / (3 * 256)), c.bound) << c.name;
  }
}

}  // namespace
}  // namespace candil::test
