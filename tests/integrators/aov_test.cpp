// AOVs of every kind of surface, and that they depend on nothing but the samples.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "core/camera.h"
#include "tests/support/aov_samples.h"

namespace candil::test {
namespace {

RenderSettings small_settings(std::vector<Aov> aovs) {
  RenderSettings settings;
  settings.width = 37, settings.height = 21;  // not a multiple of the tile
  settings.samples_per_pixel = 11;
  settings.seed = 5;
  settings.aovs = std::move(aovs);
  return settings;
}

std::vector<Aov> everything() { return {all_aovs().begin(), all_aovs().end()}; }

const Camera camera = look_at(Vec3(0, 0, 5), Vec3(0), 0.8f);

/// Glass, a lamp, a half-transparent pane, two instances of one object and a ball without triangles, with sky between.
Stage crowded_stage() {
  SceneBuilder builder;
  Material glass, pane;
  glass.metallic = 0, glass.transmission = 1, glass.thickness = 1, glass.roughness = 0.3f;
  pane.alpha_mode = AlphaMode::blend, pane.base_color = Vec4(0.9f, 0.5f, 0.1f, 0.4f), pane.is_double_sided = true;
  builder.scene.environment.tint = Vec3(0.5f);
  builder.add_sphere(Vec3(-1.2f, 0, 0), 0.8f, builder.add_material(glass), 10);
  builder.add_quad(Vec3(0, 0.5f, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), builder.add_diffuse(Vec3(0), Vec3(9)));
  builder.add_quad(Vec3(-2, -1, 1), Vec3(3, 0, 0), Vec3(0, 1.3f, 0), builder.add_material(pane));
  builder.scene.instances.push_back({"", 1, {Mat3(1), Vec3(1, -1, 0)}});
  builder.add_shape(ShapeKind::sphere, {Mat3(0.4f), Vec3(1.3f, 0, 1)}, builder.add_diffuse(Vec3(0.3f)));
  return Stage(builder.scene);
}

void expect_same_layers(const RenderResult& a, const RenderResult& b) {
  ASSERT_EQ(a.aovs.size(), b.aovs.size());
  for (std::size_t i = 0; i < a.aovs.size(); ++i) {
    EXPECT_EQ(a.aovs[i].name, b.aovs[i].name);
    EXPECT_EQ(a.aovs[i].image.pixels, b.aovs[i].image.pixels) << a.aovs[i].name;
  }
}

TEST(Aov, HasNamesThatAreFoundAgain) {
  for (const Aov aov : all_aovs()) EXPECT_EQ(aov_from_name(aov_name(aov)), aov);
  EXPECT_EQ(all_aovs().size(), 7u);
  EXPECT_FALSE(aov_from_name("Depth"));
  EXPECT_FALSE(aov_from_name(""));
}

TEST(Aov, MayBeAskedForMoreThanOnce) {
  const Stage stage = crowded_stage();
  const RenderResult once = render(stage.context(), camera, small_settings({Aov::depth}));
  const RenderResult often = render(stage.context(), camera, small_settings(std::vector<Aov>(20, Aov::depth)));
  ASSERT_EQ(often.aovs.size(), 20u);
  for (const ImageLayer& layer : often.aovs) EXPECT_EQ(layer.image.pixels, once.aovs[0].image.pixels);
}

TEST(Aov, IsBitIdenticalForAnyNumberOfThreads) {
  const Stage stage = crowded_stage();
  RenderSettings settings = small_settings(everything());
  settings.threads = 1;
  const RenderResult one = render(stage.context(), camera, settings);
  ASSERT_EQ(one.aovs.size(), 7u);
  for (const int threads : {2, 7}) {
    settings.threads = threads;
    expect_same_layers(render(stage.context(), camera, settings), one);
  }
}

// What an interrupt leaves is what a render of that many samples would have been.
TEST(Aov, FollowsThePictureWhenItIsInterrupted) {
  const Stage stage = crowded_stage();
  RenderSettings settings = small_settings(everything());
  settings.samples_per_pixel = 1u << 20;
  std::atomic<bool> stop{false};
  const auto stop_after_eight = [&](const RenderProgress& progress) { stop = progress.samples_done >= 8; };
  const RenderResult some = render(stage.context(), camera, settings, stop_after_eight, &stop);
  EXPECT_TRUE(some.was_interrupted);
  settings.samples_per_pixel = some.film.sample_count();
  expect_same_layers(render(stage.context(), camera, settings), some);
}

TEST(Aov, ChangesNothingInThePictureAndIsTheSameForEveryIntegrator) {
  const Stage stage = crowded_stage();
  RenderSettings settings = small_settings(everything());
  const RenderResult reference = render(stage.context(), camera, settings);
  for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::naive, IntegratorKind::classic,
                                    IntegratorKind::normals, IntegratorKind::albedo}) {
    settings.integrator = kind;
    settings.aovs = everything();
    const RenderResult with = render(stage.context(), camera, settings);
    expect_same_layers(with, reference);
    settings.aovs.clear();
    const RenderResult without = render(stage.context(), camera, settings);
    EXPECT_EQ(with.film.mean().pixels, without.film.mean().pixels);
    EXPECT_TRUE(without.aovs.empty());
    EXPECT_EQ(without.rays.aov, 0u);
    EXPECT_EQ(with.rays.total() - with.rays.aov, without.rays.total());
  }
}

// Once for each sample, and once for the middle of each pixel where ids are wanted.
TEST(Aov, CountsItsRays) {
  const Stage stage = crowded_stage();
  const std::uint64_t pixels = 37 * 21;
  const auto rays = [&](std::vector<Aov> aovs) {
    return render(stage.context(), camera, small_settings(std::move(aovs))).rays.aov;
  };
  EXPECT_EQ(rays({Aov::depth, Aov::uv}), 11 * pixels);
  EXPECT_EQ(rays({Aov::object}), pixels);
  EXPECT_EQ(rays({Aov::material, Aov::normals}), 12 * pixels);
}

// A pane of alpha 0.4 at z = 0, 5 m away: whatever share of the samples it stops, its depth is 5 and its position on
// it; and it stops just those that it stops in the picture, through the lens too.
TEST(Aov, MeansAreOverTheSamplesThatHit) {
  SceneBuilder builder;
  Material pane;
  pane.alpha_mode = AlphaMode::blend, pane.base_color = Vec4(1, 1, 1, 0.4f);
  builder.add_quad(Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), builder.add_material(pane));
  const Stage stage(builder.scene);
  RenderSettings settings = small_settings({Aov::depth, Aov::position, Aov::normals});
  settings.transparent_background = true;
  Camera lens = camera;
  lens.lens_radius = 0.2f, lens.focus_distance = 3;
  const RenderResult result = render(stage.context(), lens, settings);
  const Image beauty = result.film.mean();
  int partly = 0;
  for (int y = 0; y < settings.height; ++y)
    for (int x = 0; x < settings.width; ++x) {
      const float alpha = beauty.pixel(x, y)[3];
      partly += alpha > 0 && alpha < 1;
      EXPECT_NEAR(layer(result, Aov::depth).pixel(x, y)[0], alpha > 0 ? 5 : 0, 1e-5f) << x << ", " << y;
      EXPECT_EQ(layer(result, Aov::normals).pixel(x, y)[2], alpha > 0 ? 1 : 0);
      EXPECT_NEAR(layer(result, Aov::position).pixel(x, y)[2], 0, 1e-6f);
    }
  EXPECT_GT(partly, 50);
}

struct MiddlePixel {
  const char* name;
  Material material;
  Vec3 albedo;
};

Material glowing(Vec3 base, Vec3 emission) {
  Material material;
  material.metallic = 0, material.specular = 0;
  material.base_color = Vec4(base, 1);
  material.emission = emission;
  return material;
}

TEST(Aov, AlbedoOfWhatShines) {
  Material unlit;
  unlit.is_unlit = true, unlit.base_color = Vec4(0.2f, 0.4f, 0.6f, 1);
  for (const auto& [name, material, albedo] :
       {MiddlePixel{"lamp", glowing(Vec3(0.5f), Vec3(17, 12, 4)), Vec3(1)},
        MiddlePixel{"glow", glowing(Vec3(0.5f, 0.5f, 0), Vec3(0.25f)), Vec3(0.75f, 0.75f, 0.25f)},
        MiddlePixel{"unlit", unlit, Vec3(0.2f, 0.4f, 0.6f)}}) {
    SceneBuilder builder;
    builder.add_quad(Vec3(-9, -9, 0), Vec3(18, 0, 0), Vec3(0, 18, 0), builder.add_material(material));
    const Stage stage(builder.scene);
    RenderSettings settings = small_settings({Aov::albedo});
    const RenderResult result = render(stage.context(), camera, settings);
    settings.integrator = IntegratorKind::albedo;
    const RenderResult view = render(stage.context(), camera, settings);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(layer(result, Aov::albedo).pixel(18, 10)[c], albedo[c], 1e-6f) << name;
      EXPECT_NEAR(view.film.mean().pixel(18, 10)[c], albedo[c], 1e-6f) << name;
    }
  }
}

// A quad of 18 m that fills the picture, a texture of 2 x 1 texels without filter: left red, right green; u = 1/2 is
// the middle of the picture. Its back is seen from behind, and its normal turns to the viewer.
TEST(Aov, TexturesAndBacks) {
  SceneBuilder builder;
  TextureImage image;
  image.width = 2, image.height = 1;
  image.rgba8 = {{255, 0, 0, 255}, {0, 255, 0, 255}};
  builder.scene.images.push_back(image);
  builder.scene.textures.push_back({0, Wrap::repeat, Wrap::repeat, Filter::nearest});
  const std::uint32_t material = builder.add_diffuse(Vec3(1));
  builder.scene.materials[material].base_color_texture.texture = 0;
  builder.add_quad(Vec3(-9, -9, 0), Vec3(18, 0, 0), Vec3(0, 18, 0), material);
  const Stage stage(builder.scene);
  RenderSettings settings = small_settings({Aov::albedo, Aov::normals, Aov::uv});
  const RenderResult front = render(stage.context(), camera, settings);
  const RenderResult back = render(stage.context(), look_at(Vec3(0, 0, -5), Vec3(0), 0.8f), settings);
  EXPECT_EQ(layer(front, Aov::albedo).pixel(5, 10)[0], 1);
  EXPECT_EQ(layer(front, Aov::albedo).pixel(30, 10)[1], 1);
  EXPECT_EQ(layer(back, Aov::albedo).pixel(5, 10)[1], 1);
  EXPECT_EQ(layer(front, Aov::normals).pixel(5, 10)[2], 1);
  EXPECT_EQ(layer(back, Aov::normals).pixel(5, 10)[2], -1);
  // Half the picture's width at 5 m: tan(0.4) 37 / 21 5 = 3.72 m, or 0.2069 of the 18 m; the first pixel's middle is
  // 36 / 37 of that from the middle of the quad. The samples are around it, at most 1.5 pixels off.
  const float pixel = 2 * 0.2069f / 37;
  EXPECT_NEAR(layer(front, Aov::uv).pixel(0, 10)[0], 0.5f - 18 * pixel, pixel);
  EXPECT_NEAR(layer(front, Aov::uv).pixel(0, 10)[1], 0.5f, pixel);
}

// Instances first, then shapes; the second use of an object has an id of its own and the material of the first.
TEST(Aov, ObjectsAreCountedInstancesFirst) {
  SceneBuilder builder;
  const auto a = builder.add_diffuse(Vec3(0.1f)), b = builder.add_diffuse(Vec3(0.2f));
  builder.add_quad(Vec3(-2, -1, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), b);
  builder.scene.instances[0].is_world_space = false;
  builder.scene.instances.push_back({"", 0, {Mat3(1), Vec3(1.5f, 0, 0)}});
  builder.add_shape(ShapeKind::disc, {Mat3(0.6f), Vec3(1, 0, 0)}, a);
  const Stage stage(builder.scene);
  const RenderResult result = render(stage.context(), camera, small_settings({Aov::object, Aov::material}));
  // Half the picture is 3.72 m wide: x metres are at pixel 18.5 (1 + x / 3.72).
  const auto ids = [&](float x) {
    const int column = static_cast<int>(18.5f * (1 + x / 3.72f));
    return std::pair(layer(result, Aov::object).pixel(column, 10)[0],
                     layer(result, Aov::material).pixel(column, 10)[0]);
  };
  EXPECT_EQ(ids(-1.5f), std::pair(0.0f, 1.0f));
  EXPECT_EQ(ids(0), std::pair(1.0f, 1.0f));
  EXPECT_EQ(ids(1), std::pair(2.0f, 0.0f));
  EXPECT_EQ(ids(3), std::pair(-1.0f, -1.0f));
}

// Far beyond what any sum of floats could hold, and coordinates that are no numbers.
TEST(Aov, IsAlwaysFinite) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_diffuse(Vec3(0.5f));
  builder.add_shape(ShapeKind::plane, {Mat3(1), Vec3(0, 0, -1e15f)}, material);
  builder.add_quad(Vec3(-1, -1, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), material);
  for (Vec2& uv : builder.scene.meshes[0].uvs[0]) uv = Vec2(std::numeric_limits<float>::quiet_NaN(), -3e38f);
  const Stage stage(builder.scene);
  const RenderResult result = render(stage.context(), camera, small_settings(everything()));
  for (const ImageLayer& one : result.aovs)
    for (const float value : one.image.pixels) EXPECT_LE(std::abs(value), 1.00001e30f) << one.name;
  EXPECT_NEAR(layer(result, Aov::depth).pixel(1, 1)[0], 1e15f, 1e10f);
  EXPECT_NEAR(layer(result, Aov::position).pixel(1, 1)[2], -1e15f, 1e10f);
  EXPECT_EQ(layer(result, Aov::uv).pixel(18, 10)[0], 0);
  EXPECT_NEAR(layer(result, Aov::uv).pixel(18, 10)[1], -1e30f, 1e25f);
}

}  // namespace
}  // namespace candil::test
