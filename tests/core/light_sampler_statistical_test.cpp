// Lights: every density is the one that samples follow, and samples add up to the light that is there.
#include "core/light_sampler.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "core/color.h"
#include "core/emission.h"
#include "core/frame.h"
#include "core/warp.h"
#include "tests/support/brute_force.h"
#include "tests/support/chi_square.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

SurfacePoint point_at(Vec3 position, Vec3 normal = Vec3(0, 1, 0)) {
  SurfacePoint point;
  point.position = position;
  point.normal = point.normal_geometric = normal;
  return point;
}

Material emitter(Vec3 radiance) {
  Material material;
  material.emission = radiance;
  return material;
}

Mesh square(float half_side) {
  Mesh mesh;
  mesh.positions = {
      {-half_side, -half_side, 0}, {half_side, -half_side, 0}, {half_side, half_side, 0}, {-half_side, half_side, 0}};
  mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A texture of 4 x 4 bytes, uneven: two bright texels in the dark.
void add_uneven_texture(Scene& scene) {
  TextureImage image;
  image.width = image.height = 4;
  for (int i = 0; i < 16; ++i) {
    const bool is_bright = i == 2 || i == 9;
    image.rgba8.emplace_back(is_bright ? 255 : 12 * i, is_bright ? 250 : 100, 5 * i, 255);
  }
  scene.images.push_back(image);
  scene.textures.push_back({static_cast<std::uint32_t>(scene.images.size() - 1), Wrap::clamp, Wrap::clamp});
}

Image uneven_image() {
  Image image(8, 4, 3);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      const float value = (x == 2 && y == 1) ? 300.0f : (x == 5 && y == 2) ? 40.0f : (x + y) % 3 == 0 ? 0.0f : 0.5f;
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = value * (1 + 0.2f * static_cast<float>(c));
    }
  }
  return image;
}

struct LightScene {
  const char* name;
  std::function<void(SceneBuilder&)> build;
};

void PrintTo(const LightScene& scene, std::ostream* stream) { *stream << scene.name; }

void add_one_sided(SceneBuilder& builder) {
  // Above the origin, front downwards.
  builder.add_quad(Vec3(-1, 2, -0.5f), Vec3(1.5f, 0, 0), Vec3(0, 0.3f, 1),
                   builder.add_material(emitter(Vec3(3, 2, 1))));
}

void add_facing_away(SceneBuilder& builder) {
  builder.add_quad(Vec3(-1, 2.5f, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_material(emitter(Vec3(9))));
}

void add_two_sided(SceneBuilder& builder) {
  builder.add_quad(Vec3(-1.5f, 0.5f, -2), Vec3(1, 0, 0), Vec3(0.2f, 1, 0), builder.add_diffuse(Vec3(0), Vec3(1, 4, 2)));
}

void add_textured(SceneBuilder& builder) {
  add_uneven_texture(builder.scene);
  Material material = emitter(Vec3(8, 6, 10));
  material.emission_texture.texture = 0;
  builder.add_quad(Vec3(-1, 1.5f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(material));
}

void add_blended(SceneBuilder& builder) {
  add_uneven_texture(builder.scene);
  for (glm::u8vec4& texel : builder.scene.images[0].rgba8) texel.w = texel.x;
  Material material = emitter(Vec3(4));
  material.base_color_texture.texture = 0;
  material.alpha_mode = AlphaMode::blend;
  material.is_double_sided = true;
  builder.add_quad(Vec3(-1, 1.5f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(material));
}

/// One square used three times: moved, mirrored, stretched. All fronts but the last one's see the origin.
void add_instanced(SceneBuilder& builder) {
  builder.add_mesh(square(0.5f), builder.add_material(emitter(Vec3(5, 5, 2))));
  const Mat3 down(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));          // +z turned to -y
  const Mat3 stretched(Vec3(0, 0, -2), Vec3(0, 0.5f, 0), Vec3(1, 0, 0));  // +z turned to +x
  const Mat3 mirrored(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  builder.scene.instances = {{"", 0, Affine{down, Vec3(0.5f, 2, 0)}, false},
                             {"", 0, Affine{mirrored, Vec3(0, 0.5f, -2)}, false},
                             {"", 0, Affine{stretched, Vec3(-2, 0.2f, 0)}, false},
                             {"", 0, Affine{mirrored * 2.0f, Vec3(0, 0.5f, 2)}, false}};
}

void add_constant_environment(SceneBuilder& builder) { builder.scene.environment.tint = Vec3(0.5f, 1, 2); }

void add_image_environment(SceneBuilder& builder) {
  builder.scene.environment.tint = Vec3(1, 2, 0.5f);
  builder.scene.environment.image = uneven_image();
  builder.scene.environment.rotation = 1.1f;
}

void add_everything(SceneBuilder& builder) {
  add_textured(builder);
  add_two_sided(builder);
  add_facing_away(builder);
  add_image_environment(builder);
  PunctualLight lamp;
  lamp.intensity = Vec3(20);
  lamp.position = Vec3(1, 2, 1);
  builder.scene.punctual_lights = {lamp};
}

const std::array light_scenes = {
    LightScene{"one_sided", add_one_sided},
    LightScene{"facing_away", add_facing_away},
    LightScene{"two_sided", add_two_sided},
    LightScene{"textured", add_textured},
    LightScene{"blended", add_blended},
    LightScene{"instanced", add_instanced},
    LightScene{"constant_environment", add_constant_environment},
    LightScene{"image_environment", add_image_environment},
    LightScene{"everything", add_everything},
};

class Lights : public testing::TestWithParam<LightScene> {
 protected:
  Lights() {
    GetParam().build(builder_);
    scene_ = builder_.scene;
    lights_.emplace(scene_);
    faces_.emplace(scene_, BruteForce::BackFaces::visible);
  }

  /// What a ray finds, and the density with which sample() would have: the sum over everything on its line, since light
  /// sampling looks through walls.
  struct Found {
    Vec3 radiance{0.0f};
    double pdf = 0;
  };
  Found look(Vec3 from, Vec3 direction) const {
    Found found;
    if (scene_.environment.is_present()) {
      found.radiance += lights_->environment().radiance(direction);
      found.pdf += lights_->pdf_miss(direction);
    }
    for (const Crossing& crossing : faces_->crossings({from, direction})) {
      const Found on_surface = look_at(from, direction, crossing);
      found.radiance += on_surface.radiance;
      found.pdf += on_surface.pdf;
    }
    return found;
  }

  /// The same for one surface alone; nothing for a back that does not shine.
  Found look_at(Vec3 from, Vec3 direction, const Crossing& crossing) const {
    Hit hit;
    hit.barycentric = crossing.barycentric;
    hit.instance = crossing.instance, hit.mesh = crossing.mesh, hit.triangle = crossing.triangle;
    const SurfacePoint on = make_surface_point(scene_, hit);
    const Material& material = scene_.materials[on.material];
    const bool is_front = glm::dot(direction, on.normal_geometric) < 0;
    if (!is_front && !material.is_double_sided) return {};
    return {emitted_radiance(scene_, on, is_front) * alpha_coverage(scene_, material, on.uv, on.color),
            lights_->pdf_hit(from, on)};
  }

  /// Within rounding of the border of two texels the density may be looked up on its other side.
  bool is_at_border_of_texels(Vec3 direction) const {
    const Frame frame(direction);
    const auto differs_across = [&](Vec3 step) {
      const float before = lights_->pdf_miss(glm::normalize(direction - 1e-5f * step));
      const float after = lights_->pdf_miss(glm::normalize(direction + 1e-5f * step));
      return std::abs(after - before) > 0.01f * glm::max(before, after);
    };
    return differs_across(frame.tangent) || differs_across(frame.bitangent);
  }

  SceneBuilder builder_;
  Scene scene_;
  std::optional<LightSampler> lights_;
  std::optional<BruteForce> faces_;
};

// Each sample is checked against the strategy that would have found its light by chance: density and radiance.
TEST_P(Lights, SamplesReportTheDensityOfTheirDirection) {
  Random random(1);
  int compared = 0;
  const SurfacePoint from = point_at(Vec3(0.1f, 0, 0.2f));
  for (int i = 0; i < 40000; ++i) {
    const float pick = random.next_1d();
    const std::optional<LightSample> sample = lights_->sample(from, pick, random.next_2d());
    if (!sample) continue;
    ASSERT_TRUE(is_finite(sample->wi) && is_finite(sample->radiance)) << i;
    ASSERT_TRUE(std::isfinite(sample->pdf) && sample->pdf > 0) << i;
    ASSERT_NEAR(glm::length(sample->wi), 1, 1e-5f);
    if (sample->is_delta) continue;
    // The one light that was picked is the one where the shadow ray ends.
    Found found;
    if (sample->shadow_ray.t_max == infinity) {
      if (is_at_border_of_texels(sample->wi)) continue;
      found = {lights_->environment().radiance(sample->wi), lights_->pdf_miss(sample->wi)};
    } else {
      for (const Crossing& crossing : faces_->crossings({from.position, sample->wi})) {
        if (std::abs(crossing.t - sample->shadow_ray.t_max) > 1e-4) continue;
        found = look_at(from.position, sample->wi, crossing);
      }
    }
    ++compared;
    ASSERT_NEAR(sample->pdf, found.pdf, 1e-3 * found.pdf) << i;
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(sample->radiance[c], found.radiance[c], 1e-3f * found.radiance[c] + 1e-4f) << i;
    }
  }
  if (std::string_view(GetParam().name) == "facing_away") {
    EXPECT_EQ(compared, 0);
  } else {
    EXPECT_GT(compared, 5000);
  }
}

// Irradiance on planes that face several ways: the mean of radiance cos / pdf over light samples against an
// integral over the hemisphere by directions that know nothing of lights.
TEST_P(Lights, SamplesAddUpToTheIrradiance) {
  for (const Vec3 normal : {Vec3(0, 1, 0), glm::normalize(Vec3(-1, 0.5f, -0.3f))}) {
    const SurfacePoint from = point_at(Vec3(0.1f, 0, 0.2f), normal);
    const Frame frame(normal);
    Random random(2);
    struct Mean {
      double sum = 0, squares = 0;
      int n = 0;
      void add(double x) { sum += x, squares += x * x, ++n; }
      double value() const { return sum / n; }
      double error() const { return std::sqrt(std::max(0.0, squares / n - value() * value()) / n); }
    } sampled, searched;
    for (int i = 0; i < 200000; ++i) {
      const float pick = random.next_1d();
      const std::optional<LightSample> sample = lights_->sample(from, pick, random.next_2d());
      const bool counts = sample && !sample->is_delta;
      sampled.add(counts ? luminance(sample->radiance) * glm::max(0.0f, glm::dot(sample->wi, normal)) / sample->pdf
                         : 0);
    }
    // Stratified over 700 x 700 cells of a cosine-weighted hemisphere: mean radiance times pi.
    constexpr int side = 700;
    for (int i = 0; i < side * side; ++i) {
      const Vec2 u = (Vec2(i % side, i / side) + random.next_2d()) / static_cast<float>(side);
      searched.add(pi * luminance(look(from.position, frame.to_world(sample_cosine_hemisphere(u))).radiance));
    }
    const double error = std::hypot(sampled.error(), searched.error());
    EXPECT_NEAR(sampled.value(), searched.value(), 6 * error + 1e-4 * searched.value());
    EXPECT_LE(error, 0.02 * searched.value()) << "too noisy to tell";
  }
}

// Directions follow the sum of the densities of all that lies on their line.
TEST_P(Lights, DirectionsFollowTheDensity) {
  const SurfacePoint from = point_at(Vec3(0.1f, 0, 0.2f));
  // Cells of light directions, expected shares by a fine regular grid: the outlines of lights make adaptive integration
  // pointless, so the expectation has a sampling error of its own, about a tenth of the counts' one.
  const SphereGrid grid{6, 12};
  constexpr int samples = 20000, fine = 150;
  std::vector<double> observed(grid.rows * grid.columns + 1), expected(observed.size());
  Random random(3);
  for (int i = 0; i < samples; ++i) {
    const float pick = random.next_1d();
    const std::optional<LightSample> sample = lights_->sample(from, pick, random.next_2d());
    ++observed[sample && !sample->is_delta ? grid.cell_of(sample->wi) : observed.size() - 1];
  }
  double total = 0;
  for (std::size_t cell = 0; cell + 1 < observed.size(); ++cell) {
    double sum = 0;
    for (int i = 0; i < fine * fine; ++i) {
      const Vec2 jitter = random.next_2d();
      const double row = static_cast<double>(cell) / grid.columns;
      const Vec3 direction = grid.direction(std::floor(row) + (i / fine + jitter.y) / fine,
                                            static_cast<double>(cell % grid.columns) + (i % fine + jitter.x) / fine);
      sum += look(from.position, direction).pdf;
    }
    expected[cell] = samples * sum * grid.cell_solid_angle() / (fine * fine);
    total += expected[cell];
  }
  EXPECT_LT(total, 1.005 * samples);
  expected.back() = std::max(0.0, samples - total);
  if (expected.back() < 0.005 * samples) {  // every draw gives a direction, up to the error of the expectation
    EXPECT_LT(observed.back(), 0.005 * samples);
    expected.back() = observed.back();
  }
  EXPECT_GT(chi_square_test(observed, expected).p_value, significance);
}

// A point behind a light gets nothing from it, and no numbers at the rim of [0, 1) make a bad sample, wherever the
// point is: in the plane of a light, at one of its corners, on it.
TEST_P(Lights, ExtremeNumbersAndPlacesGiveSoundSamples) {
  const std::array numbers = {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, one_minus_epsilon};
  for (const Vec3 position : {Vec3(0), Vec3(-1, 2, -0.5f), Vec3(0, 2.5f, 0), Vec3(0, 1.5f, 0), Vec3(-1, 1.5f, 5),
                              Vec3(0, 3, 0), Vec3(0, 1e6f, 0), Vec3(-1.5f, 0.5f, -2)}) {
    for (const float pick : numbers) {
      for (const float x : numbers) {
        for (const float y : numbers) {
          const std::optional<LightSample> sample = lights_->sample(point_at(position), pick, {x, y});
          if (!sample) continue;
          EXPECT_TRUE(is_finite(sample->wi) && is_finite(sample->radiance));
          EXPECT_TRUE(is_finite(sample->shadow_ray.origin) && is_finite(sample->shadow_ray.direction));
          EXPECT_GE(min_component(sample->radiance), 0);
          EXPECT_TRUE(std::isfinite(sample->pdf) && sample->pdf > 0) << sample->pdf;
          EXPECT_GT(sample->shadow_ray.t_max, 0);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Lights, testing::ValuesIn(light_scenes),
                         [](const auto& test) { return test.param.name; });

// Behind a one-sided light there is none of it; behind a two-sided one there is.
TEST(LightSampler, BackSidesShineOnlyIfDoubleSided) {
  for (const bool is_double_sided : {false, true}) {
    SceneBuilder builder;
    Material material = emitter(Vec3(1));
    material.is_double_sided = is_double_sided;
    builder.add_quad(Vec3(-1, 0, 1), Vec3(2, 0, 0), Vec3(0, 0, -2), builder.add_material(material));  // faces up
    const LightSampler lights(builder.scene);
    Random random(4);
    int above = 0, below = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = random.next_2d();
      const float pick = random.next_1d();
      above += lights.sample(point_at(Vec3(0, 2, 0)), pick, u).has_value();
      below += lights.sample(point_at(Vec3(0, -2, 0)), pick, u).has_value();
    }
    EXPECT_EQ(above, 1000);
    EXPECT_EQ(below, is_double_sided ? 1000 : 0);
  }
}

// Lights are picked in proportion to their power: pi area L per side of an emitter, 4 pi I of a point light.
TEST(LightSampler, FrequenciesArePowerShares) {
  SceneBuilder builder;
  builder.add_quad(Vec3(-1, 5, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_material(emitter(Vec3(3))));  // 4 m2
  builder.add_quad(Vec3(-4, 5, -1), Vec3(1, 0, 0), Vec3(0, 0, 1), builder.add_diffuse(Vec3(0), Vec3(7)));   // two sides
  PunctualLight lamp;
  lamp.position = Vec3(3, 1, 0);
  lamp.intensity = Vec3(2);
  builder.scene.punctual_lights = {lamp};
  const LightSampler lights(builder.scene);
  ASSERT_EQ(lights.light_count(), 5u);
  const double one_sided = pi * 4 * 3, two_sided = 2 * pi * 1 * 7, point = 4 * pi * 2;
  const double total = one_sided + two_sided + point;
  constexpr int n = 100000;
  std::array<double, 3> observed{};
  Random random(5);
  for (int i = 0; i < n; ++i) {
    const float pick = random.next_1d();
    const std::optional<LightSample> sample = lights.sample(point_at(Vec3(0)), pick, random.next_2d());
    ASSERT_TRUE(sample);
    ++observed[sample->is_delta ? 2 : sample->radiance.x > 5 ? 1 : 0];
    if (sample->is_delta) {
      EXPECT_NEAR(sample->pdf, point / total, 1e-5);
    }
  }
  const std::array expected = {n * one_sided / total, n * two_sided / total, n * point / total};
  EXPECT_GT(chi_square_test(observed, expected).p_value, significance);
}

TEST(LightSampler, WithoutLightsIsEmpty) {
  SceneBuilder builder;
  builder.add_quad(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), builder.add_diffuse(Vec3(1)));
  const LightSampler lights(builder.scene);
  EXPECT_TRUE(lights.is_empty());
  EXPECT_EQ(lights.pdf_hit(Vec3(0, 0, 1), make_surface_point(builder.scene, Hit{})), 0);
  EXPECT_EQ(lights.pdf_miss(Vec3(0, 1, 0)), 0);
}

}  // namespace
}  // namespace candil::test
