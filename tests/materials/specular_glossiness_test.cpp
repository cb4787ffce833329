#include <gtest/gtest.h>

#include "core/color.h"
#include "materials/bsdf.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

// The texture's colours are sRGB and its glossiness is linear; both multiply the factors, glossiness as 1 - roughness.
TEST(SpecularGlossiness, TextureMultipliesSpecularAndGlossiness) {
  Scene scene;
  TextureImage image;
  image.width = image.height = 1;
  image.rgba32 = {Vec4(0.8f, 0.6f, 0.4f, 0.5f)};
  scene.images = {image};
  scene.textures = {Texture{}};
  Material textured;
  textured.model = MaterialModel::specular_glossiness;
  textured.base_color = Vec4(0.7f, 0.8f, 0.9f, 1);
  textured.specular_color = Vec3(0.5f, 1, 1);
  textured.roughness = 0.4f;
  textured.specular_color_texture.texture = 0;
  scene.materials = {textured};
  const BsdfTables tables(scene);
  Material plain = textured;
  plain.specular_color_texture = {};
  plain.specular_color = Vec3(0.5f * srgb_to_linear(0.8f), srgb_to_linear(0.6f), srgb_to_linear(0.4f));
  plain.roughness = 0.7f;  // 1 - 0.6 x 0.5
  const ClosureBench bench(plain);
  const Vec3 wo = direction_at(50), wi = direction_at(20);
  SurfacePoint point;
  point.normal = point.normal_geometric = Vec3(0, 0, 1);
  const BsdfEval a = make_bsdf(scene, tables, point, wo).eval(wo, wi), b = bench.bsdf(wo).eval(wo, wi);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.f_cos[c], b.f_cos[c], 1e-6f);
  EXPECT_NEAR(a.pdf, b.pdf, 1e-6f);
}

}  // namespace
}  // namespace candil::test
