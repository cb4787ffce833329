// KHR_materials_volume_scatter, an experiment: where light goes in volumes that scatter.
#include <gtest/gtest.h>

#include <cmath>

#include "core/frame.h"
#include "core/warp.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// A volume with a boundary that neither reflects nor bends light, unless `boundary` says otherwise.
Material load_volume(const std::string& scatter, const std::string& attenuation,
                     const std::string& boundary =
                         R"("KHR_materials_ior":{"ior":1},"KHR_materials_specular":{"specularFactor":0},
                            "KHR_materials_transmission":{"transmissionFactor":1})",
                     bool is_experimental = true) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{)" + boundary +
                      R"(,"KHR_materials_volume":{"thicknessFactor":1,)" + attenuation +
                      R"(},"KHR_materials_volume_scatter":{)" + scatter + "}}}"};
  sample.root = R"(,"extensionsUsed":["KHR_materials_volume_scatter"])";
  LoadOptions options;
  if (is_experimental) options.experiments = {"KHR_materials_volume_scatter"};
  return load_sample(sample, options).scene.materials.at(0);
}

Stage cube_in_white_light(const Material& material) {
  SceneBuilder builder;
  builder.add_cube(Vec3(0), 0.5f, builder.add_material(material), false);
  builder.scene.environment.tint = Vec3(1);
  return Stage(builder.scene);
}

const Ray down{Vec3(0.1f, 2, 0.2f), Vec3(0, -1, 0)};

// White scatterers lose nothing: light from everywhere looks the same through them. Channels differ in density, which
// leaves noise of bounded weights; one colour leaves none.
TEST(GltfVolumeScatter, WhiteScatterersAreAFurnace) {
  const std::string white = R"("multiscatterColor":[1,1,1],"scatterAnisotropy":0.5)";
  for (const char* attenuation : {R"("attenuationColor":[0.2,0.2,0.2],"attenuationDistance":0.2)",
                                  R"("attenuationColor":[0.9,0.3,0.1],"attenuationDistance":0.5)"}) {
    for (const char* boundary :
         {R"("KHR_materials_ior":{"ior":1},"KHR_materials_transmission":{"transmissionFactor":1})",
          R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":1})"}) {
      Material material = load_volume(white, attenuation, boundary);
      material.extensions->multiscatter_color = Vec3(1);  // files may not go quite so far
      const Stage stage = cube_in_white_light(material);
      for (const Integrator integrator : {trace_path, trace_naive}) {
        const Estimate e = estimate_radiance(stage, integrator, down, 16384);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(e.mean[c], 1, 6 * e.standard_error[c] + 0.01f);
        EXPECT_LT(max_component(e.standard_error), 0.02f);
      }
    }
  }
}

// The same in glass, smooth and rough, out of which light finds its way only after some reflections. Nothing is lost
// but by the walks that are cut off.
TEST(GltfVolumeScatter, WhiteScatterersInGlassAreAFurnace) {
  for (const float roughness : {0.0f, 0.3f, 1.0f}) {
    for (const float coat : {0.0f, 1.0f}) {
      Material material = load_volume(R"("multiscatterColor":[1,1,1],"scatterAnisotropy":0.3)",
                                      R"("attenuationColor":[0.2,0.2,0.2],"attenuationDistance":0.3)",
                                      R"("KHR_materials_transmission":{"transmissionFactor":1})");
      material.roughness = roughness;
      material.extensions->multiscatter_color = Vec3(1);
      material.extensions->clearcoat = coat;
      const Stage stage = cube_in_white_light(material);
      for (const Integrator integrator : {trace_path, trace_naive}) {
        const Estimate e = estimate_radiance(stage, integrator, down, 16384);
        EXPECT_GT(e.mean.x, 0.99f - 6 * e.standard_error.x) << roughness << " coat " << coat;
        EXPECT_LT(e.mean.x, 1.005f + 6 * e.standard_error.x) << roughness << " coat " << coat;
        EXPECT_LT(e.standard_error.x, 0.01f);
      }
    }
  }
}

// Nearly black scatterers absorb: through one metre, Beer and Lambert's law with the whole extinction.
TEST(GltfVolumeScatter, BlackScatterersAttenuateByBeerLambert) {
  const Stage stage = cube_in_white_light(load_volume(R"("multiscatterColor":[0.0001,0.0001,0.0001])",
                                                      R"("attenuationColor":[0.9,0.5,0.2],"attenuationDistance":0.5)"));
  for (const Integrator integrator : {trace_path, trace_naive, trace_classic}) {
    const Estimate e = estimate_radiance(stage, integrator, down, 16384);
    const Vec3 expected(0.81f, 0.25f, 0.04f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e.mean[c], expected[c], 6 * e.standard_error[c] + 1e-3f);
  }
}

// The parameter is the albedo of a thick body: what a half space returns of white light, on the mean over all
// directions by their cosine. The cube is 70 free paths thick, and what it returns comes from the first few.
TEST(GltfVolumeScatter, ThickBodiesHaveTheColourOfTheParameter) {
  const Stage stage = cube_in_white_light(load_volume(
      R"("multiscatterColor":[0.8,0.5,0.2])", R"("attenuationColor":[0.5,0.5,0.5],"attenuationDistance":0.01)"));
  glm::dvec3 sum(0);
  constexpr std::uint32_t count = 20000;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Sampler sampler({7, 8}, i, 9);
    const Vec3 towards = Frame(Vec3(0, 1, 0)).to_world(sample_cosine_hemisphere(sampler.sample_2d(12345)));
    RayCounts rays;
    const Ray ray{Vec3(0, 0.5f, 0) + 2.0f * towards, -towards};
    sum += trace_path(stage.context(), RenderSettings{}, ray, sampler, rays).radiance;
  }
  const Vec3 expected(0.8f, 0.5f, 0.2f);
  // Single paths are below 3 and vary by less than 1: the standard error is below 0.007.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / count, expected[c], 0.03) << "channel " << c;
}

// Without the switch the volume only attenuates, as it does where nothing scatters.
TEST(GltfVolumeScatter, IsAnExperiment) {
  const std::string attenuation = R"("attenuationColor":[0.9,0.5,0.2],"attenuationDistance":0.5)";
  const std::string glass = R"("KHR_materials_transmission":{"transmissionFactor":1})";
  const auto radiance = [&](const Material& material) {
    return estimate_radiance(cube_in_white_light(material), trace_path, down, 256).mean;
  };
  const std::string scatter = R"("multiscatterColor":[0.5,0.5,0.5])";
  Material none = load_volume(scatter, attenuation, glass);
  none.extensions.reset();
  EXPECT_EQ(radiance(load_volume(scatter, attenuation, glass, false)), radiance(none));
  EXPECT_EQ(radiance(load_volume(R"("multiscatterColor":[0,0,0])", attenuation, glass)), radiance(none));
  EXPECT_NE(radiance(load_volume(scatter, attenuation, glass)), radiance(none));
}

}  // namespace
}  // namespace candil::test
