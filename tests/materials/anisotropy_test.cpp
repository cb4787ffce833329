// What anisotropy adds to what holds for every closure (bsdf_test.cpp): its directions, and that energy is kept at all
// of its strengths and azimuths.
#include "materials/anisotropy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <optional>

#include "core/sampler.h"
#include "materials/ggx.h"
#include "tests/support/closure_bench.h"

namespace candil::test {
namespace {

Material brushed(float roughness, float strength, float rotation = 0) {
  Material m;
  m.roughness = roughness;
  m.extensions.emplace();
  m.extensions->anisotropy = strength;
  m.extensions->anisotropy_rotation = rotation;
  return m;
}

Vec3 direction(float degrees, float azimuth) {
  const float theta = glm::radians(degrees), phi = glm::radians(azimuth);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The materials of roughnesses and strengths, which share their tables.
class BrushedBench {
 public:
  explicit BrushedBench(const Material& material) {
    for (const float roughness : {0.0f, 0.05f, 0.12f, 0.27f, 0.45f, 0.7f, 0.95f}) {
      for (const float strength : {0.15f, 0.35f, 0.57f, 0.75f, 0.9f, 1.0f}) {
        Material m = material;
        m.roughness = roughness;
        if (!m.extensions) m.extensions.emplace();
        m.extensions->anisotropy = strength;
        scene_.materials.push_back(m);
      }
    }
    tables_.emplace(scene_);
  }

  /// White furnace at those angles and several azimuths: within 1 %, and half of that above.
  void expect_furnace(std::initializer_list<float> angles, std::uint32_t samples = 4096) const {
    constexpr float least = 0.99f, most = 1.005f;
    SurfacePoint point;
    point.normal_geometric = point.normal = Vec3(0, 0, 1);
    for (point.material = 0; point.material < scene_.materials.size(); ++point.material) {
      for (const float azimuth : {0.0f, 20.0f, 55.0f, 75.0f, 90.0f}) {
        for (const float degrees : angles) {
          const Vec3 wo = direction(degrees, azimuth);
          const Vec3 energy = furnace(make_bsdf(scene_, *tables_, point, wo), wo, samples, least, most);
          const Material& m = scene_.materials[point.material];
          const auto place = [&] {
            return testing::Message() << "roughness " << m.roughness << " strength " << m.extensions->anisotropy
                                      << " azimuth " << azimuth << " at " << degrees << " degrees";
          };
          EXPECT_GT(min_component(energy), least) << place();
          EXPECT_LT(max_component(energy), most) << place();
        }
      }
    }
  }

 private:
  Scene scene_;
  std::optional<BsdfTables> tables_;
};

Material glass(float ior) {
  Material m;
  m.metallic = 0, m.transmission = 1, m.thickness = 1;
  m.ior = ior;
  return m;
}

Material filmed(Material m) {
  m.extensions.emplace();
  m.extensions->iridescence = 1;
  m.extensions->iridescence_ior = 1.8f;
  m.extensions->iridescence_thickness = 300;
  return m;
}

constexpr std::initializer_list<float> front = {0.0f, 45.0f, 70.0f, 80.0f, 87.0f, 89.0f};
constexpr std::initializer_list<float> both_sides = {0.0f,  45.0f,  85.0f,  89.0f,  91.0f,
                                                     95.0f, 105.0f, 130.0f, 140.0f, 165.0f};

/// Of colours there are more samples, and fewer angles: facets are chosen by brightness, and each channel is noisier.
constexpr std::uint32_t coloured = 12288;
constexpr std::initializer_list<float> some_of_both_sides = {0.0f, 80.0f, 89.0f, 91.0f, 105.0f, 140.0f};

TEST(Anisotropy, WhiteMetalKeepsAllEnergy) { BrushedBench(Material{}).expect_furnace(front); }

TEST(Anisotropy, WhitePlasticKeepsAllEnergy) {
  Material plastic;
  plastic.metallic = 0;
  BrushedBench(plastic).expect_furnace(front);
}

TEST(Anisotropy, ThinSheetKeepsAllEnergy) {
  Material sheet;
  sheet.metallic = 0, sheet.transmission = 1;
  BrushedBench(sheet).expect_furnace(front);
}

TEST(Anisotropy, GlassKeepsAllEnergy) { BrushedBench(glass(1.5f)).expect_furnace(both_sides); }

TEST(Anisotropy, DiamondKeepsAllEnergy) { BrushedBench(glass(2.42f)).expect_furnace(both_sides); }

TEST(Anisotropy, FilmedGlassKeepsAllEnergy) {
  BrushedBench(filmed(glass(1.5f))).expect_furnace(some_of_both_sides, coloured);
}

TEST(Anisotropy, GlassOfColouredSpecularKeepsAllEnergy) {
  Material m = glass(1.5f);
  m.specular = 0.7f;
  m.specular_color = Vec3(4, 1.5f, 0.2f);
  BrushedBench(m).expect_furnace(some_of_both_sides, coloured);
}

// The extension's formula, by hand: along the tangent 0.3^2 grows by 0.6^2 of what is missing to 1, 0.09 + 0.36 x 0.91.
TEST(Anisotropy, RoughnessGrowsAlongTheTangent) {
  const Vec2 alpha = anisotropic_alpha(0.3f, 0.6f);
  EXPECT_NEAR(alpha.x, 0.4176f, 1e-6f);
  EXPECT_NEAR(alpha.y, 0.09f, 1e-6f);
  // Burley's distribution at two facets as far from the normal: wider along x.
  const Vec3 along(0.6f, 0, 0.8f), across(0, 0.6f, 0.8f);
  const auto burley = [&](Vec3 h) {
    return 1 / (pi * alpha.x * alpha.y * sqr(sqr(h.x / alpha.x) + sqr(h.y / alpha.y) + sqr(h.z)));
  };
  EXPECT_NEAR(ggx_distribution(along, alpha) / burley(along), 1, 1e-5f);
  EXPECT_NEAR(ggx_distribution(across, alpha) / burley(across), 1, 1e-5f);
  EXPECT_GT(ggx_distribution(along, alpha), 5 * ggx_distribution(across, alpha));
}

// Smith's condition: the facets that are visible from a direction, seen from there, have its own projected area.
TEST(Anisotropy, VisibleFacetsCoverTheSurface) {
  const Vec2 alpha = anisotropic_alpha(0.5f, 0.7f);
  for (const float azimuth : {0.0f, 30.0f, 90.0f}) {
    const Vec3 wo = direction(65, azimuth);
    constexpr int rows = 512, columns = 1024;
    double sum = 0;
    for (int r = 0; r < rows; ++r) {
      const double z = (r + 0.5) / rows, radius = std::sqrt(1 - z * z);
      for (int c = 0; c < columns; ++c) {
        const double phi = 2 * pi * (c + 0.5) / columns;
        const Vec3 h(radius * std::cos(phi), radius * std::sin(phi), z);
        sum += ggx_distribution(h, alpha) * glm::max(0.0f, glm::dot(wo, h)) * (2 * pi / (rows * columns));
      }
    }
    EXPECT_NEAR(ggx_masking(wo, alpha) * sum / wo.z, 1, 1e-3) << azimuth;
  }
}

TEST(Anisotropy, StrengthZeroIsTheIsotropicMaterialToTheBit) {
  Material plain;
  plain.roughness = 0.35f;
  const ClosureBench expected(plain), found(brushed(0.35f, 0));
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Sampler s({1, 2}, i, 3);
    const Vec3 wo = direction(80 * s.sample_2d(0).x, 360 * s.sample_2d(0).y);
    const auto a = expected.bsdf(wo).sample(wo, s.sample_2d(1).x, s.sample_2d(2));
    const auto b = found.bsdf(wo).sample(wo, s.sample_2d(1).x, s.sample_2d(2));
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_EQ(a->wi, b->wi);
    EXPECT_EQ(a->weight, b->weight);
    EXPECT_EQ(a->pdf, b->pdf);
  }
}

// Turned by a right angle, the surface does to turned directions what it did to the others.
TEST(Anisotropy, RotationByARightAngleExchangesTheAxes) {
  const ClosureBench straight(brushed(0.3f, 0.8f)), turned(brushed(0.3f, 0.8f, pi / 2));
  const auto turn = [](Vec3 w) { return Vec3(-w.y, w.x, w.z); };
  int compared = 0;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Sampler s({1, 2}, i, 3);
    const Vec3 wo = direction(80 * s.sample_2d(0).x, 360 * s.sample_2d(0).y);
    const Vec3 wi = direction(80 * s.sample_2d(1).x, 360 * s.sample_2d(1).y);
    const BsdfEval a = straight.bsdf(wo).eval(wo, wi), b = turned.bsdf(turn(wo)).eval(turn(wo), turn(wi));
    EXPECT_NEAR(a.f_cos.x, b.f_cos.x, 1e-3f * a.f_cos.x);
    EXPECT_NEAR(a.pdf, b.pdf, 1e-3f * a.pdf);
    compared += std::abs(a.f_cos.x - straight.bsdf(turn(wo)).eval(turn(wo), turn(wi)).f_cos.x) > 0.1f * a.f_cos.x;
  }
  EXPECT_GT(compared, 50) << "the axes look the same";
}

// Red and green are the direction from -1 to 1, blue is a factor of the strength: this texel, (0, 1) and 0.5, makes of
// strength 0.8 half of it along the bitangent.
TEST(Anisotropy, TextureTurnsAndWeakens) {
  Scene scene;
  scene.materials = {brushed(0.3f, 0.8f), brushed(0.3f, 0.4f, pi / 2)};
  TextureImage image;
  image.width = image.height = 1;
  image.rgba32 = {Vec4(0.5f, 1, 0.5f, 1)};
  scene.images = {image};
  scene.textures = {Texture{}};
  scene.materials[0].extensions->anisotropy_texture.texture = 0;
  const BsdfTables tables(scene);
  SurfacePoint textured, plain;
  textured.normal_geometric = plain.normal_geometric = textured.normal = plain.normal = Vec3(0, 0, 1);
  textured.tangent = plain.tangent = Vec4(0.6f, 0.8f, 0, -1);  // mirrored, which an axis does not mind
  plain.material = 1;
  const Vec3 wo = direction(50, 20), wi = direction(40, 160);
  const float expected = make_bsdf(scene, tables, plain, wo).eval(wo, wi).f_cos.x;
  EXPECT_NEAR(make_bsdf(scene, tables, textured, wo).eval(wo, wi).f_cos.x, expected, 1e-4f * expected);
}

}  // namespace
}  // namespace candil::test
