// KHR_materials_anisotropy from the file to the picture: a brushed mirror under a small light stretches its highlight
// along the direction of the material, and only along it.
#include <gtest/gtest.h>

#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// Radiances of a point that is looked at along its normal under a lamp of 1 cd in 5 m, at atan(3 / 4) from the normal:
/// towards +x, and towards +y. The surface is a triangle in the plane z = 0 without tangents, whose u runs along x.
struct Highlights {
  float along_x, along_y;
};

Highlights highlights(const std::string& anisotropy) {
  GltfSample sample;
  const int positions = sample.add_accessor<float>(gl_float, "VEC3", 3, {-9, -9, 0, 9, -9, 0, 0, 9, 0},
                                                   R"(,"min":[-9,-9,0],"max":[9,9,0])");
  const int normals = sample.add_accessor<float>(gl_float, "VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int uvs = sample.add_accessor<float>(gl_float, "VEC2", 3, {0, 1, 1, 1, 0.5f, 0});  // v runs downwards
  sample.meshes = {R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(positions) + R"(,"NORMAL":)" +
                   std::to_string(normals) + R"(,"TEXCOORD_0":)" + std::to_string(uvs) + R"(},"material":0}]})"};
  sample.nodes = {R"({"mesh":0})"};
  sample.materials = {R"({"pbrMetallicRoughness":{"roughnessFactor":0.3},
                          "extensions":{"KHR_materials_anisotropy":{)" +
                      anisotropy + "}}}"};
  sample.root = R"(,"extensionsUsed":["KHR_materials_anisotropy"],"extensionsRequired":["KHR_materials_anisotropy"])";
  const LoadedScene loaded = load_sample(sample);
  EXPECT_TRUE(loaded.extensions_unsupported.empty());
  const auto seen = [&](Vec3 lamp) {
    SceneBuilder builder;
    builder.scene = loaded.scene;
    PunctualLight light;
    light.position = lamp;
    builder.scene.punctual_lights = {light};
    return estimate_radiance(Stage(builder.scene), trace_path, Ray{Vec3(0, 0, 5), Vec3(0, 0, -1)}, 16).mean.x;
  };
  return {seen(Vec3(3, 0, 4)), seen(Vec3(0, 3, 4))};
}

// Nothing is random here: the lamp is the only light, and what is seen is f cos / 25. The facet that reflects it leans
// by half of the angle: h = (1, 0, 3) / sqrt(10). Roughness 0.3 and strength 0.6 make alpha 0.4176 along the direction
// and 0.09 across it. By the formulas of the extension's text, with F = 1 for a white metal:
//   along it  D = 1 / (pi 0.4176 0.09 (0.1 / 0.4176^2 + 0.9)^2) = 3.902, V = 0.5 / (0.8 + |0.2506, 0.8|) = 0.3052,
//   across it D = 1 / (pi 0.4176 0.09 (0.1 / 0.09^2 + 0.9)^2) = 0.04827, V = 0.5 / (0.8 + |0.054, 0.8|) = 0.3122;
// D V cos = 0.9527 and 0.01206. Light that facets reflect more than once, which the text leaves out, adds to both, but
// no more than all that is lost, spread by the cosine: about 0.2 / pi x 0.8 = 0.05.
void expect_stretched(float along, float across) {
  EXPECT_GT(25 * along, 0.9527f - 1e-3f);
  EXPECT_LT(25 * along, 0.9527f + 0.05f);
  EXPECT_GT(25 * across, 0.01206f - 1e-4f);
  EXPECT_LT(25 * across, 0.01206f + 0.05f);
}

TEST(GltfAnisotropy, StretchesHighlightsAlongTheTangent) {
  const Highlights seen = highlights(R"("anisotropyStrength":0.6)");
  expect_stretched(seen.along_x, seen.along_y);
}

TEST(GltfAnisotropy, RotationTurnsThem) {
  const Highlights seen = highlights(R"("anisotropyStrength":0.6,"anisotropyRotation":1.5707963)");
  expect_stretched(seen.along_y, seen.along_x);
}

}  // namespace
}  // namespace candil::test
