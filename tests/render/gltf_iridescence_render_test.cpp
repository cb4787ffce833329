// KHR_materials_iridescence from the file to the picture: colours of thin films that follow from their optical path.
#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// Radiance of a smooth triangle of that material, looked at along its normal, with white light behind the viewer or
/// behind the triangle.
Vec3 seen(const std::string& material, bool light_is_behind_viewer) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");  // in the plane z = 0, its front towards +z
  sample.materials = {material};
  sample.root = R"(,"extensionsUsed":["KHR_materials_iridescence","KHR_materials_ior","KHR_materials_transmission"],
                    "extensionsRequired":["KHR_materials_iridescence"])";
  const LoadedScene loaded = load_sample(sample);
  EXPECT_TRUE(loaded.extensions_unsupported.empty());
  SceneBuilder builder;
  builder.scene = loaded.scene;
  builder.add_quad(Vec3(-9, -9, light_is_behind_viewer ? 5 : -5), Vec3(18, 0, 0), Vec3(0, 18, 0),
                   builder.add_diffuse(Vec3(0), Vec3(1)));
  return estimate_radiance(Stage(builder.scene), trace_path, Ray{Vec3(0.2f, 0.2f, 1), Vec3(0, 0, -1)}, 16384).mean;
}

/// `film` are members of the extension, `more` further extensions.
std::string black_material(const std::string& film, const std::string& more = "") {
  return R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0,"baseColorFactor":[0,0,0,1]},
             "extensions":{"KHR_materials_iridescence":{)" +
         film + "}" + more + "}}";
}

// Index 1.3 on 1.5, 400 nm: both waves change their phase alike, and 2 x 1.3 x 400 = 1040 nm between them are two
// wavelengths of green (520), one and a half of red (693) and two and a half of violet (416). Where they add up, the
// film is not there: 0.04. Where they cancel out, amplitudes of 0.1304 and 0.0714 leave
// (0.0590 / (1 - 0.1304 x 0.0714))^2 = 0.0035.
TEST(GltfIridescence, FilmOnADielectricIsGreenAtTwoWavelengths) {
  const Vec3 radiance = seen(black_material(R"("iridescenceFactor":1,"iridescenceIor":1.3)"), true);
  EXPECT_GT(radiance.y, 0.025f);
  EXPECT_LT(radiance.y, 0.045f);
  for (const float other : {radiance.x, radiance.z}) {
    EXPECT_GT(other, 0.003f);
    EXPECT_LT(other, 0.75f * radiance.y);
  }
}

TEST(GltfIridescence, FactorMixesWithTheBareSurface) {
  const Vec3 whole = seen(black_material(R"("iridescenceFactor":1)"), true);
  const Vec3 half = seen(black_material(R"("iridescenceFactor":0.5)"), true);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], 0.5f * (whole[c] + 0.04f), 1e-4f);
}

// A film in air: only its front changes the phase, so that it is darkest where the path is a wavelength.
// 2 x 1.33 x 200 = 532 nm, green; red (620 nm) and blue (450 nm) are off by 0.14 and 0.18 of a wavelength, where
// sin^2 of half of the phase is 0.19 and 0.29 of the brightest, (2 x 0.1416 / (1 + 0.1416^2))^2 = 0.0771.
// What is not reflected goes through.
TEST(GltfIridescence, SoapBubbleReflectsOrTransmits) {
  const std::string soap = R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{
      "KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceIor":1.33,"iridescenceThicknessMaximum":200},
      "KHR_materials_ior":{"ior":1},"KHR_materials_transmission":{"transmissionFactor":1}}})";
  const Vec3 reflected = seen(soap, true), transmitted = seen(soap, false);
  // Reflection or transmission is a matter of chance: 16384 samples, well distributed ones, tell 0.03 to within 0.004.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflected[c] + transmitted[c], 1, 0.01f);
  EXPECT_LT(reflected.y, 0.5f * reflected.x);
  EXPECT_LT(reflected.y, 0.5f * reflected.z);
  EXPECT_LT(max_component(reflected), 0.0771f);
  EXPECT_GT(max_component(reflected), 0.01f);
}

}  // namespace
}  // namespace candil::test
