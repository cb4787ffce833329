// KHR_materials_dispersion: a prism sends each colour where Snell's law with Cauchy's index says.
#include <gtest/gtest.h>

#include <cmath>

#include "core/wavelength.h"
#include "tests/support/gltf/gltf_sample.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

Material load_glass(float dispersion) {
  GltfSample sample;
  sample.add_triangle("", ",\"material\":0");
  sample.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{
      "KHR_materials_ior":{"ior":1.6},"KHR_materials_transmission":{"transmissionFactor":1},
      "KHR_materials_volume":{"thicknessFactor":1},"KHR_materials_dispersion":{"dispersion":)" +
                      std::to_string(dispersion) + "}}}"};
  sample.root = R"(,"extensionsUsed":["KHR_materials_dispersion"],"extensionsRequired":["KHR_materials_dispersion"])";
  return load_sample(sample).scene.materials.at(0);
}

using Point = glm::dvec2;

double reflectance(double cos_i, double sin_i, double eta) {
  const double cos_t = std::sqrt(1 - sin_i * sin_i / (eta * eta));
  const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t), s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return (p * p + s * s) / 2;
}

/// Snell's law in the plane, `normal` against the direction.
Point refracted(Point direction, Point normal, double eta) {
  const double cos_i = -glm::dot(direction, normal), sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  return direction / eta + (cos_i / eta - std::sqrt(1 - sin2_t)) * normal;
}

/// An equilateral prism with corners (-1, 0), (1, 0) and (0, sqrt 3) in the plane z = 0, and a ray that crosses both of
/// its slanted sides.
constexpr double root = std::numbers::sqrt3_v<double>;
const Point origin(-2, 0), direction = glm::normalize(Point(1.5, 0.8)), left(-root / 2, 0.5), right(root / 2, 0.5);
constexpr double screen_x = 3;
constexpr std::uint32_t sample_count = 1 << 17;

struct Exit {
  double y;              // where it meets the screen
  double transmittance;  // of both sides together; the first one reflects all wavelengths like the mean one
};

Exit through_prism(double ior, double mean_ior) {
  const auto meet = [](Point from, Point towards, Point normal) {  // both sides are root / 2 from (0, 0)
    return from + (root / 2 - glm::dot(from, normal)) / glm::dot(towards, normal) * towards;
  };
  const Point first = meet(origin, direction, left), inside = refracted(direction, left, ior);
  const Point second = meet(first, inside, right), out = refracted(inside, -right, 1 / ior);
  const double cos_in = -glm::dot(direction, left), cos_out = glm::dot(inside, right);
  const double t = (1 - reflectance(cos_in, std::sqrt(1 - cos_in * cos_in), mean_ior)) *
                   (1 - reflectance(cos_out, std::sqrt(1 - cos_out * cos_out), 1 / ior));
  return {second.y + (screen_x - second.x) / out.x * out.y, t};
}

double cauchy(double ior, double dispersion, double nanometres) {
  return ior + (ior - 1) * dispersion / 20 * (523655 / (nanometres * nanometres) - 1.5168);
}

/// Two refractions and a strip of the screen, of radiance 1, that wavelengths between two reach.
Estimate radiance_of_strip(float dispersion, double y_low, double y_high) {
  SceneBuilder builder;
  const std::uint32_t glass = builder.add_material(load_glass(dispersion));
  const auto side = [&](Point a, Point b) {  // the front is to the right of the way from a to b
    const Vec3 edge(static_cast<float>(b.x - a.x), static_cast<float>(b.y - a.y), 0);
    builder.add_quad(Vec3(static_cast<float>(a.x), static_cast<float>(a.y), -1), edge, Vec3(0, 0, 2), glass);
  };
  side({-1, 0}, {1, 0}), side({1, 0}, {0, root}), side({0, root}, {-1, 0});
  builder.add_quad(Vec3(static_cast<float>(screen_x), static_cast<float>(y_low), -1), Vec3(0, 0, 2),
                   Vec3(0, static_cast<float>(y_high - y_low), 0), builder.add_diffuse(Vec3(0), Vec3(1)));
  const Ray ray{Vec3(Vec2(origin), 0), Vec3(Vec2(direction), 0)};
  return estimate_radiance(Stage(builder.scene), trace_path, ray, sample_count, 2);
}

// The light of a strip is that of the wavelengths that reach it: the integral of response and transmittance over them.
TEST(GltfDispersion, PrismDeflectsByTheSpecificationsIndices) {
  constexpr double ior = 1.6, dispersion = 1;
  for (const auto& [shortest, longest] : {std::pair(600.0, 650.0), std::pair(530.0, 560.0), std::pair(440.0, 470.0)}) {
    const auto y_of = [&](double nm) { return through_prism(cauchy(ior, dispersion, nm), ior).y; };
    ASSERT_LT(y_of(shortest), y_of(longest)) << "blue is bent further down";
    glm::dvec3 expected(0);
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
      const Wavelength w = sample_wavelength((static_cast<float>(i) + 0.5f) / count);
      if (w.nanometres < shortest || w.nanometres > longest) continue;
      expected += glm::dvec3(w.response) * through_prism(cauchy(ior, dispersion, w.nanometres), ior).transmittance /
                  static_cast<double>(count);
    }
    const Estimate e = radiance_of_strip(dispersion, y_of(shortest), y_of(longest));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(e.mean[c], expected[c], 6 * e.standard_error[c] + 1e-4) << shortest << " nm, channel " << c;
    }
    EXPECT_GT(max_component(Vec3(expected)), 0.2f);
  }
  // Without dispersion all light goes where 587.56 nm went.
  const Exit mean = through_prism(ior, ior);
  const Estimate e = radiance_of_strip(0, mean.y - 1e-3, mean.y + 1e-3);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(e.mean[c], mean.transmittance, 6 * e.standard_error[c] + 1e-4);
}

// A clear ball in light from everywhere loses nothing and takes no colour. Wavelengths are stratified and leave no
// noise that counts; the choice between reflection and refraction has a standard deviation of about 0.7, 0.003 of 65536
// samples. Rough glass looks up what its facets lose for the mean index (1 %).
TEST(GltfDispersion, WhiteStaysWhite) {
  for (const float roughness : {0.0f, 0.3f}) {
    SceneBuilder builder;
    Material glass = load_glass(2);
    glass.roughness = roughness;
    builder.add_sphere(Vec3(0), 1, builder.add_material(glass), 32);
    builder.scene.environment.tint = Vec3(1);
    const Stage stage(builder.scene);
    for (const Integrator integrator : {trace_path, trace_naive}) {
      const Ray ray{Vec3(0.3f, 2, 0.8f), glm::normalize(Vec3(-0.3f, -2, -0.4f))};
      const Estimate e = estimate_radiance(stage, integrator, ray, 65536);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(e.mean[c], 1, roughness > 0 ? 0.03f : 0.02f) << "roughness " << roughness << " channel " << c;
      }
    }
  }
}

}  // namespace
}  // namespace candil::test
