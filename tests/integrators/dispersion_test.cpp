// What a path does with its wavelength.
#include <gtest/gtest.h>

#include "core/wavelength.h"
#include "integrators/path_state.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

const Ray down_to_origin{Vec3(0.3f, 2, 0.4f), glm::normalize(Vec3(-0.3f, -2, -0.4f))};

Material glass(float roughness, float dispersion) {
  Material m;
  m.metallic = 0;
  m.roughness = roughness;
  m.transmission = m.thickness = 1;
  m.extensions.emplace().dispersion = dispersion;
  return m;
}

// The samples of a pixel take their wavelengths from one dimension of its own, stratified: of the first 2^k one falls
// into each 2^k-th of the interval, so the mean response misses white by the total variation over 2^k at most.
TEST(Dispersion, WhiteIsWhiteToOneOverTheSamples) {
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
    glm::dvec3 sum(0);
    for (std::uint32_t i = 0; i < 4096; ++i) {
      sum += sample_wavelength(Sampler({pixel, 3}, i, 5).sample_2d(dimension::wavelength).x).response;
      const std::uint32_t n = i + 1;
      if ((n & (n - 1)) != 0) continue;
      for (int c = 0; c < 3; ++c) EXPECT_LE(std::abs(sum[c] / n - 1), 7.0 / n + 1e-6) << n << " samples";
    }
  }
}

// Paths that meet no dispersion have their bits, and so have those that meet a dispersion of zero.
TEST(Dispersion, ZeroEqualsNone) {
  for (const float roughness : {0.0f, 0.4f}) {
    Material without = glass(roughness, 0);
    without.extensions.reset();
    const auto radiance = [&](const Material& material, Integrator integrator) {
      SceneBuilder builder;
      builder.add_sphere(Vec3(0), 1, builder.add_material(material), 16);
      builder.add_quad(Vec3(-3, -1.5f, 3), Vec3(6, 0, 0), Vec3(0, 0, -6), builder.add_diffuse(Vec3(0.5f), Vec3(0.1f)));
      builder.scene.environment.tint = Vec3(1, 2, 3);
      return estimate_radiance(Stage(builder.scene), integrator, down_to_origin, 64).mean;
    };
    for (const Integrator integrator : {trace_path, trace_naive, trace_classic}) {
      EXPECT_EQ(radiance(glass(roughness, 0), integrator), radiance(without, integrator));
      EXPECT_NE(radiance(glass(roughness, 2), integrator), radiance(without, integrator));
    }
  }
}

// A camera inside of the glass sees colours too: its paths choose before they scatter.
TEST(Dispersion, PathsThatBeginInsideChooseAtOnce) {
  Scene scene;
  scene.materials = {glass(0, 1)};
  SurfacePoint point;  // its front is +y
  const Sampler sampler({1, 2}, 3, 4);
  for (const bool is_inside : {false, true}) {
    PathState state;
    state.ray.direction = Vec3(0, is_inside ? 1 : -1, 0);
    const Wavelength first = wavelength_at(state, scene, point, sampler);
    EXPECT_GT(first.nanometres, 0);
    EXPECT_EQ(state.wavelength, is_inside ? first.nanometres : 0);
    EXPECT_EQ(is_inside ? state.throughput : first.response,
              sample_wavelength(sampler.sample_2d(dimension::wavelength).x).response);
    EXPECT_EQ(is_inside ? first.response : state.throughput, Vec3(1));
    state.wavelength = 500;
    EXPECT_EQ(wavelength_at(state, scene, point, sampler).nanometres, 500) << "once chosen, it stays";
  }
}

}  // namespace
}  // namespace candil::test
