// Emissive shapes: directions follow the density that they report, and the density is that of what rays find.
#include "core/shape_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/light_sampler.h"
#include "core/warp.h"
#include "materials/alpha.h"
#include "tests/support/chi_square.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

struct LightCase {
  const char* name;
  ShapeKind kind;
  Affine to_world;
  Vec3 from;
  bool is_double_sided = false;
  bool is_visible = true;  // from there
};

void PrintTo(const LightCase& light, std::ostream* stream) { *stream << light.name; }

const Mat3 stretched = Mat3(Vec3(0.36f, 0.48f, -0.8f), Vec3(-0.8f, 0.6f, 0), Vec3(0.48f, 0.64f, 0.6f)) *
                       Mat3(Vec3(2, 0, 0), Vec3(0, 0.3f, 0), Vec3(0, 0, 0.8f));
const Mat3 sheared_mirrored(Vec3(0.5f, 0.2f, 0), Vec3(-0.4f, 1.5f, 0.3f), Vec3(0, 0.6f, -1));
const Mat3 downwards(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0));  // +z turned to -y

const LightCase cases[] = {
    {"sphere", ShapeKind::sphere, {Mat3(0.7f), Vec3(0, 2, 0)}, Vec3(0.3f, 0, 0.1f)},
    {"sphere_nearby", ShapeKind::sphere, {Mat3(2), Vec3(0, 2, 0)}, Vec3(0, -0.01f, 0)},
    {"sphere_mirrored", ShapeKind::sphere, {Mat3(-0.7f), Vec3(0, 2, 0)}, Vec3(2, 0, 0)},
    {"sphere_from_inside", ShapeKind::sphere, {Mat3(2), Vec3(0, 1, 0)}, Vec3(0, 0.5f, 1), true},
    {"sphere_from_its_center", ShapeKind::sphere, {Mat3(2), Vec3(0, 1, 0)}, Vec3(0, 1, 0), true},
    {"sphere_inside_dark", ShapeKind::sphere, {Mat3(2), Vec3(0, 1, 0)}, Vec3(0, 0.5f, 1), false, false},
    {"ellipsoid", ShapeKind::sphere, {stretched, Vec3(0, 2, 0)}, Vec3(0.3f, 0, 0.1f)},
    {"ellipsoid_sheared", ShapeKind::sphere, {sheared_mirrored, Vec3(2, 1, 1)}, Vec3(0, -0.4f, 0)},
    {"ellipsoid_from_inside", ShapeKind::sphere, {sheared_mirrored, Vec3(0)}, Vec3(0.1f, 0.3f, 0.2f), true},
    {"disc", ShapeKind::disc, {downwards, Vec3(0.5f, 1.5f, 0)}, Vec3(0)},
    {"disc_stretched", ShapeKind::disc, {stretched, Vec3(0.5f, 1, 0)}, Vec3(0, 3, 2)},
    {"disc_from_behind", ShapeKind::disc, {downwards, Vec3(0, 1.5f, 0)}, Vec3(0, 3, 0), false, false},
    {"disc_two_sided", ShapeKind::disc, {downwards, Vec3(0, 1.5f, 0)}, Vec3(0, 3, 0), true},
    {"plane", ShapeKind::plane, {downwards, Vec3(0, 1.5f, 0)}, Vec3(1, 0, 2)},
    {"plane_oblique", ShapeKind::plane, {sheared_mirrored, Vec3(0, 0, -3)}, Vec3(0, 0, -40)},
    {"plane_from_behind", ShapeKind::plane, {downwards, Vec3(0, 1.5f, 0)}, Vec3(0, 2, 0), false, false},
    {"plane_two_sided", ShapeKind::plane, {downwards, Vec3(0, 1.5f, 0)}, Vec3(0, 2, 0), true},
};

class ShapeLights : public testing::TestWithParam<LightCase> {
 protected:
  ShapeLights() {
    const LightCase& light = GetParam();
    Material material;
    material.emission = Vec3(3, 2, 1);
    material.is_double_sided = light.is_double_sided;
    SceneBuilder builder;
    builder.add_shape(light.kind, light.to_world, builder.add_material(material));
    scene_ = builder.scene;
    accelerator_ = make_accelerator(scene_, alpha_filter());
    lights_ = std::make_unique<LightSampler>(scene_);
    from_.position = light.from;
  }

  std::optional<LightSample> sample(Random& random) const { return lights_->sample(from_, 0.5, random.next_2d()); }
  /// Of the direction: that of what a ray finds.
  float pdf(Vec3 direction) const {
    const std::optional<Hit> hit = accelerator_->intersect({from_.position, direction});
    return hit ? lights_->pdf_hit(from_.position, make_surface_point(scene_, *hit)) : 0;
  }

  Scene scene_;
  std::unique_ptr<Accelerator> accelerator_;
  std::unique_ptr<LightSampler> lights_;
  SurfacePoint from_;
};

TEST_P(ShapeLights, SamplesReportTheDensityOfWhatTheirRayFinds) {
  Random random(1);
  int compared = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const std::optional<LightSample> light = sample(random);
    if (!light) continue;
    ASSERT_TRUE(GetParam().is_visible);
    ASSERT_TRUE(light->pdf > 0 && light->pdf < infinity);
    ASSERT_NEAR(glm::length(light->wi), 1, 1e-6f);
    ASSERT_EQ(light->radiance, Vec3(3, 2, 1));
    ASSERT_FALSE(accelerator_->occluded(light->shadow_ray)) << "a light in its own shadow";
    Ray beyond = light->shadow_ray;
    beyond.t_max = light->shadow_ray.t_max * 1.001f;
    const std::optional<Hit> hit = accelerator_->intersect({from_.position, light->wi});
    if (!hit || !accelerator_->occluded(beyond)) continue;  // at the rim, within rounding
    ++compared;
    ASSERT_NEAR(light->pdf, pdf(light->wi), 1e-4f * light->pdf);
  }
  EXPECT_GE(compared, GetParam().is_visible ? 0.99 * count : 0);
}

// Cells of direction; their expected shares from a fine jittered grid, with a tenth of the counts' error. Whole: one.
TEST_P(ShapeLights, DirectionsFollowTheDensity) {
  const SphereGrid grid{12, 24};
  constexpr int count = 20000, fine = 64;
  const std::size_t cells = static_cast<std::size_t>(grid.rows) * grid.columns;
  std::vector<double> observed(cells + 1), expected(cells + 1);
  Random random(2);
  for (int i = 0; i < count; ++i) {
    const std::optional<LightSample> light = sample(random);
    ++observed[light ? grid.cell_of(light->wi) : cells];
  }
  double total = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto row = static_cast<double>(cell / grid.columns), column = static_cast<double>(cell % grid.columns);
    double sum = 0;
    for (int i = 0; i < fine * fine; ++i) {
      const Vec2 jitter = random.next_2d();
      sum += pdf(grid.direction(row + (i / fine + jitter.y) / fine, column + (i % fine + jitter.x) / fine));
    }
    expected[cell] = count * sum * grid.cell_solid_angle() / (fine * fine);
    total += expected[cell] / count;
  }
  EXPECT_NEAR(total, GetParam().is_visible ? 1 : 0, 0.005);
  expected[cells] = GetParam().is_visible ? observed[cells] : count;
  EXPECT_LT(observed[cells], GetParam().is_visible ? 10 : count + 1) << "samples lost";
  EXPECT_GT(chi_square_test(observed, expected).p_value, significance);
}

INSTANTIATE_TEST_SUITE_P(All, ShapeLights, testing::ValuesIn(cases), [](const auto& test) { return test.param.name; });

// Numbers at the rim of [0, 1) and places on, at and far from the lights.
TEST(ShapeLight, ExtremeNumbersAndPlacesGiveSoundSamples) {
  const float numbers[] = {0, 0x1p-24f, 0.25f, 0.5f, 0.75f, one_minus_epsilon};
  for (const LightCase& light : cases) {
    for (const bool is_double_sided : {false, true}) {
      SceneBuilder builder;
      builder.add_shape(light.kind, light.to_world, builder.add_diffuse(Vec3(0.5f), Vec3(1)));
      builder.scene.materials[0].is_double_sided = is_double_sided;
      const LightSampler lights(builder.scene);
      const Vec3 center = light.to_world.translation;
      for (const Vec3 place :
           {center, light.to_world.point(Vec3(0, 0, 1)), light.to_world.point(Vec3(1, 0, 0)), center + Vec3(0, 1e6f, 0),
            center - Vec3(1e6f, 1, 0), center + Vec3(1e-6f, 1e-6f, 0), Vec3(1e15f, 1e15f, -1e15f)}) {
        SurfacePoint from;
        from.position = place;
        from.offset = surface_offset(max_component(glm::abs(place)));
        for (const float x : numbers) {
          for (const float y : numbers) {
            const std::optional<LightSample> sample = lights.sample(from, 0.3, {x, y});
            if (!sample) continue;
            EXPECT_TRUE(is_finite(sample->wi) && is_finite(sample->radiance)) << light.name;
            EXPECT_TRUE(is_finite(sample->shadow_ray.origin) && is_finite(sample->shadow_ray.direction));
            EXPECT_TRUE(sample->pdf > 0 && sample->pdf < infinity) << light.name;
            EXPECT_GT(sample->shadow_ray.t_max, 0) << light.name;
          }
        }
      }
    }
  }
}

// Seen from afar, the rounding of a ray is large beside a small light: its own surface must not be in its way. A light
// at the world's origin has the smallest coordinates of all, and so has a triangle.
TEST(ShapeLight, SmallOnesAreNotInTheirOwnShadow) {
  const float size = 0.02f;
  for (int kind = 0; kind < 3; ++kind) {
    SceneBuilder builder;
    const auto lamp = builder.add_diffuse(Vec3(0), Vec3(1));
    if (kind == 0) builder.add_shape(ShapeKind::sphere, {size * Mat3(1), Vec3(0)}, lamp);
    if (kind == 1) builder.add_shape(ShapeKind::disc, {size * downwards, Vec3(0)}, lamp);
    if (kind == 2) builder.add_quad(Vec3(-size, 0, -size), Vec3(2 * size, 0, 0), Vec3(0, 0, 2 * size), lamp);
    const auto accelerator = make_accelerator(builder.scene, alpha_filter());
    const LightSampler lights(builder.scene);
    Random random(6);
    for (const float distance : {1.0f, 10.0f, 1000.0f}) {
      int in_shadow = 0;
      for (int i = 0; i < 5000; ++i) {
        const Vec2 place = random.next_2d();
        SurfacePoint from;
        from.position = distance * Vec3(place.x, -1, place.y);
        from.offset = surface_offset(distance);
        const float pick = random.next_1d();
        const std::optional<LightSample> sample = lights.sample(from, pick, random.next_2d());
        in_shadow += !sample || accelerator->occluded(sample->shadow_ray);
      }
      EXPECT_EQ(in_shadow, 0) << "kind " << kind << " from " << distance;
    }
  }
}

// Lights are chosen by power: pi L times the area, of an ellipsoid by Thomsen's formula (1.2 % off at most), twice that
// with two sides; of a plane 2 pi times the disc that the scene shows to each direction.
TEST(ShapeLight, Power) {
  SceneBuilder builder;
  const auto one_sided = builder.add_diffuse(Vec3(0), Vec3(2)), two_sided = builder.add_diffuse(Vec3(0), Vec3(2));
  builder.scene.materials[one_sided].is_double_sided = false;
  const auto power = [&](ShapeKind kind, const Mat3& linear, std::uint32_t material) {
    const std::uint32_t shape = builder.add_shape(kind, {linear, Vec3(5)}, material);
    return ShapeLight(builder.scene, shape).power(3);
  };
  EXPECT_NEAR(power(ShapeKind::sphere, Mat3(0.5f), one_sided), pi * 2 * 4 * pi * 0.25f, 1e-4f);
  EXPECT_NEAR(power(ShapeKind::sphere, Mat3(-0.5f), two_sided), 2 * pi * 2 * 4 * pi * 0.25f, 1e-4f);
  const float a = 2, b = 0.5f, c = 1, p = 1.6075f;
  const float mean = (std::pow(a * b, p) + std::pow(a * c, p) + std::pow(b * c, p)) / 3;
  const float ellipsoid = pi * 2 * 4 * pi * std::pow(mean, 1 / p);
  EXPECT_NEAR(power(ShapeKind::sphere, Mat3(a, 0, 0, 0, b, 0, 0, 0, c), one_sided), ellipsoid, 0.03f * ellipsoid);
  EXPECT_NEAR(power(ShapeKind::disc, Mat3(a, 0, 0, 0, b, 0, 0, 0, c), one_sided), pi * 2 * pi * a * b, 1e-4f);
  EXPECT_NEAR(power(ShapeKind::plane, Mat3(7), one_sided), pi * 2 * 2 * pi * 9, 1e-3f);
  Mat3 flat(1);
  flat[0] = Vec3(0);
  EXPECT_EQ(power(ShapeKind::sphere, flat, one_sided), 0);
}

// Half of the disc's image shines twice as much as the other: the mean counts.
TEST(ShapeLight, PowerKnowsTheTexture) {
  SceneBuilder builder;
  const auto material = builder.add_diffuse(Vec3(0), Vec3(1));
  TextureImage image;
  image.width = 2, image.height = 1;
  image.rgba32 = {Vec4(Vec3(0), 1), Vec4(1)};
  builder.scene.images = {image};
  builder.scene.textures = {Texture{0, Wrap::clamp, Wrap::clamp, Filter::nearest}};
  builder.scene.materials[material].emission_texture.texture = 0;
  builder.scene.materials[material].is_double_sided = false;
  builder.add_shape(ShapeKind::disc, Affine{}, material);
  EXPECT_NEAR(ShapeLight(builder.scene, 0).power(1), 0.5f * pi * pi, 1e-4f);
}

}  // namespace
}  // namespace candil::test
