// What rays do not see: culled back faces, holes of masks, and the part of a blended surface that is not there.
#include "materials/alpha.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/accelerator_cases.h"
#include "tests/support/chi_square.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// A square of half side 1 in the plane z = 0, front towards +z, with u to the right and v downwards.
Mesh facing_square() {
  Mesh mesh;
  mesh.positions = {{-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}};
  mesh.uvs[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

enum class Placement { world_space, instanced, mirrored };

/// Every way to get there, behind every kind of accelerator.
struct Setting {
  AcceleratorChoice accelerator;
  Placement placement = Placement::world_space;
};

std::vector<Setting> all_settings() {
  std::vector<Setting> settings;
  for (const AcceleratorChoice& accelerator : accelerator_choices()) {
    for (const Placement placement : {Placement::world_space, Placement::instanced, Placement::mirrored}) {
      settings.push_back({accelerator, placement});
    }
  }
  return settings;
}

std::string setting_name(const testing::TestParamInfo<Setting>& test) {
  constexpr std::array names = {"world_space", "instanced", "mirrored"};
  return test.param.accelerator.name() + "_" + names[static_cast<std::size_t>(test.param.placement)];
}

/// The square alone, at the same place and with its front towards +z however it gets there.
Stage square_stage(const Material& material, Setting setting, Scene textures = {}) {
  SceneBuilder builder;
  builder.scene = std::move(textures);
  builder.add_mesh(facing_square(), builder.add_material(material));
  Instance& instance = builder.scene.instances[0];
  instance.is_world_space = setting.placement == Placement::world_space;
  if (setting.placement == Placement::instanced) {
    for (Vec3& p : builder.scene.meshes[0].positions) p = 2.0f * p - Vec3(0, 0, 4);
    instance.to_world = {Mat3(0.5f), Vec3(0, 0, 2)};
  }
  // Mirrored at the plane x = 0, the square covers itself. The front stays the front (glTF 2.0, section 3.7.4).
  if (setting.placement == Placement::mirrored) instance.to_world.linear[0].x = -1;
  return Stage(builder.scene, setting.accelerator);
}

struct Seen {
  bool from_front, from_back;
};

/// Rays at a point off the diagonal from both sides; intersect() and occluded() must agree.
Seen look(const Stage& stage) {
  const auto sees = [&](float side) {
    const Ray ray{Vec3(0.3f, 0.1f, 3 * side), Vec3(0, 0, -side)};
    const bool is_hit = stage.accelerator().intersect(ray).has_value();
    EXPECT_EQ(stage.accelerator().occluded(ray), is_hit);
    return is_hit;
  };
  return {sees(1), sees(-1)};
}

class BackFace : public testing::TestWithParam<Setting> {};

TEST_P(BackFace, OfSingleSidedIsInvisible) {
  const Seen seen = look(square_stage(Material{}, GetParam()));
  EXPECT_TRUE(seen.from_front);
  EXPECT_FALSE(seen.from_back);
}

TEST_P(BackFace, OfDoubleSidedIsVisible) {
  Material material;
  material.is_double_sided = true;
  const Seen seen = look(square_stage(material, GetParam()));
  EXPECT_TRUE(seen.from_front);
  EXPECT_TRUE(seen.from_back);
}

TEST_P(BackFace, OfTransmissiveIsVisible) {
  Material material;
  material.transmission = 0.5f;
  const Seen seen = look(square_stage(material, GetParam()));
  EXPECT_TRUE(seen.from_front);
  EXPECT_TRUE(seen.from_back);
}

TEST_P(BackFace, HidesNothingBehindIt) {
  SceneBuilder builder;
  Scene scene = square_stage(Material{}, GetParam()).scene();
  builder.scene = scene;
  builder.add_quad(Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 2, 0), builder.add_diffuse(Vec3(0.5f)));
  const Stage stage(builder.scene, GetParam().accelerator);
  const auto hit = stage.accelerator().intersect({Vec3(0.3f, 0.1f, -3), Vec3(0, 0, 1)});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->mesh, 1u);
  EXPECT_NEAR(hit->t, 4, 1e-5f);
}

INSTANTIATE_TEST_SUITE_P(All, BackFace, testing::ValuesIn(all_settings()), setting_name);

class Mask : public testing::TestWithParam<AcceleratorChoice> {};

// Texels of alpha 0, 127, 128 and 255 from left to right, looked up without interpolation. A cutoff of 0.5 lies between
// 127/255 = 0.498 and 128/255 = 0.502.
TEST_P(Mask, IsCutByTheTexture) {
  Scene textures;
  TextureImage image;
  image.width = 4, image.height = 1;
  for (const int alpha : {0, 127, 128, 255}) image.rgba8.emplace_back(255, 255, 255, alpha);
  textures.images = {image};
  textures.textures = {{0, Wrap::clamp, Wrap::clamp, Filter::nearest}};
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.base_color_texture.texture = 0;
  for (const auto& [factor, expected] :
       {std::pair(1.0f, std::array{false, false, true, true}), std::pair(0.99f, std::array{false, false, false, true}),
        std::pair(0.4f, std::array{false, false, false, false})}) {
    material.base_color.w = factor;
    const Stage stage = square_stage(material, {GetParam(), Placement::world_space}, textures);
    for (int texel = 0; texel < 4; ++texel) {
      const Ray ray{Vec3(-0.75f + 0.5f * static_cast<float>(texel), 0.1f, 2), Vec3(0, 0, -1)};
      EXPECT_EQ(stage.accelerator().intersect(ray).has_value(), expected[texel]) << factor << ", texel " << texel;
      EXPECT_EQ(stage.accelerator().occluded(ray), expected[texel]) << factor << ", texel " << texel;
    }
  }
}

// Alpha comes from vertex colours too: 0 on the left, 1 on the right, so that the cutoff of 0.25 lies at x = -0.5.
TEST_P(Mask, IsCutByVertexColours) {
  SceneBuilder builder;
  Mesh mesh = facing_square();
  mesh.colors = {Vec4(1, 1, 1, 0), Vec4(1, 1, 1, 0), Vec4(1), Vec4(1)};
  Material material;
  material.alpha_mode = AlphaMode::mask;
  material.alpha_cutoff = 0.25f;
  builder.add_mesh(mesh, builder.add_material(material));
  const Stage stage(builder.scene, GetParam());
  const auto sees = [&](float x) { return stage.accelerator().occluded({Vec3(x, 0.2f, 2), Vec3(0, 0, -1)}); };
  EXPECT_FALSE(sees(-0.9f));
  EXPECT_FALSE(sees(-0.51f));
  EXPECT_TRUE(sees(-0.49f));
  EXPECT_TRUE(sees(0.9f));
}

INSTANTIATE_TEST_SUITE_P(All, Mask, testing::ValuesIn(accelerator_choices()), choice_name);

Material blended(float alpha) {
  Material material;
  material.alpha_mode = AlphaMode::blend;
  material.base_color.w = alpha;
  material.is_double_sided = true;
  return material;
}

/// A ray at a random point of the square from a random point on the side of z.
Ray random_ray_at_square(Random& random, float z) {
  const Vec2 from = 2.0f * random.next_2d() - 1.0f, at = 1.8f * random.next_2d() - 0.9f;
  const Vec3 origin(from, z);
  return {origin, glm::normalize(Vec3(at, 0) - origin)};
}

// Number of successes in n draws of probability p deviates by more than 5 standard deviations less than once in a
// million times (normal tail 6e-7; n p (1 - p) is large enough).
void expect_binomial(int count, int n, double p) {
  EXPECT_NEAR(count, n * p, 5 * std::sqrt(n * p * (1 - p))) << "p = " << p;
}

class Blend : public testing::TestWithParam<Setting> {};

TEST_P(Blend, StopsTheFractionAlphaOfRays) {
  constexpr int n = 20000;
  for (const float alpha : {0.05f, 0.3f, 0.5f, 0.9f}) {
    const Stage stage = square_stage(blended(alpha), GetParam());
    Random random(1);
    for (const float side : {2.0f, -2.0f}) {
      int stopped = 0;
      for (int i = 0; i < n; ++i) {
        const Ray ray = random_ray_at_square(random, side);
        const bool is_hit = stage.accelerator().intersect(ray).has_value();
        stopped += is_hit;
        ASSERT_EQ(stage.accelerator().occluded(ray), is_hit);
        ASSERT_EQ(stage.accelerator().intersect(ray).has_value(), is_hit) << "the same ray, asked again";
      }
      expect_binomial(stopped, n, alpha);
    }
  }
}

// Parallel rays, too, and rays from one point that differ in a few bits only: neighbours in a picture.
TEST_P(Blend, IsNoPatternForNeighbouringRays) {
  constexpr int side = 150;
  const Stage stage = square_stage(blended(0.5f), GetParam());
  int parallel = 0, from_point = 0, alike = 0;
  bool before = false;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 place = 0.001f * (Vec2(i % side, i / side) + 0.5f);
    const bool is_hit = stage.accelerator().occluded({Vec3(place, 2), Vec3(0, 0, -1)});
    parallel += is_hit;
    alike += i > 0 && is_hit == before;
    before = is_hit;
    from_point += stage.accelerator().occluded({Vec3(0, 0, 2), glm::normalize(Vec3(place, -2))});
  }
  expect_binomial(parallel, side * side, 0.5);
  expect_binomial(from_point, side * side, 0.5);
  expect_binomial(alike, side * side - 1, 0.5);
}

TEST_P(Blend, FullAlphaStopsAllAndNoneStopsNothing) {
  Random random(2);
  const Stage opaque = square_stage(blended(1), GetParam()), absent = square_stage(blended(0), GetParam());
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_ray_at_square(random, 2);
    ASSERT_TRUE(opaque.accelerator().occluded(ray));
    ASSERT_FALSE(absent.accelerator().occluded(ray));
  }
}

INSTANTIATE_TEST_SUITE_P(All, Blend, testing::ValuesIn(all_settings()), setting_name);

class BlendLayers : public testing::TestWithParam<AcceleratorChoice> {};

// Layers are independent of each other: three of alpha a let (1 - a)^3 through, be they triangles of one mesh, of
// several meshes or of several instances of one. Which of them a ray finds first does not change whether it gets
// through: a shadow ray and a path ray agree.
TEST_P(BlendLayers, AreIndependent) {
  constexpr int n = 40000;
  constexpr float alpha = 0.4f;
  for (const bool is_instanced : {false, true}) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material(blended(alpha));
    for (int layer = 0; layer < 3; ++layer) {
      const float z = -0.5f * static_cast<float>(layer);
      if (is_instanced) {
        if (layer == 0) builder.add_mesh(facing_square(), material);
        builder.scene.instances.resize(layer);
        builder.scene.instances.push_back({"", 0, Affine{Mat3(1.2f), Vec3(0, 0, z)}, false});
      } else {
        Mesh mesh = facing_square();
        for (Vec3& p : mesh.positions) p = 1.2f * p + Vec3(0, 0, z);
        builder.add_mesh(std::move(mesh), material);
      }
    }
    const Stage stage(builder.scene, GetParam());
    Random random(3);
    int first = 0, second = 0, third = 0;
    for (int i = 0; i < n; ++i) {
      const Vec2 at = 2.0f * random.next_2d() - 1.0f;
      const Ray ray{Vec3(at, 2), glm::normalize(Vec3(0.05f * (random.next_2d() - 0.5f), -1))};
      const std::optional<Hit> hit = stage.accelerator().intersect(ray);
      ASSERT_EQ(stage.accelerator().occluded(ray), hit.has_value());
      if (!hit) continue;
      const std::uint32_t layer = is_instanced ? hit->instance : hit->mesh;
      ++(layer == 0 ? first : layer == 1 ? second : third);
    }
    expect_binomial(first, n, alpha);
    expect_binomial(second, n, alpha * (1 - alpha));
    expect_binomial(third, n, alpha * (1 - alpha) * (1 - alpha));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BlendLayers, testing::ValuesIn(accelerator_choices()), choice_name);

}  // namespace
}  // namespace candil::test
