// The render loop: same bits whatever the threads, and a picture whatever interrupts it.
#include "integrators/render.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/camera.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

Stage small_stage() {
  SceneBuilder builder;
  Material glass;
  glass.metallic = 0, glass.roughness = 0.3f, glass.transmission = 1, glass.thickness = 1;
  glass.alpha_mode = AlphaMode::blend;
  glass.base_color = Vec4(0.9f, 0.8f, 0.7f, 0.6f);
  builder.add_cube(Vec3(0), 3, builder.add_diffuse(Vec3(0.6f, 0.5f, 0.4f)), true);
  builder.add_quad(Vec3(-1, 2.5f, -1), Vec3(2, 0, 0), Vec3(0, 0, 2), builder.add_diffuse(Vec3(0), Vec3(9)));
  builder.add_sphere(Vec3(0), 1, builder.add_material(glass), 12);
  return Stage(builder.scene);
}

RenderSettings small_settings() {
  RenderSettings settings;
  settings.width = 45, settings.height = 37;  // not a multiple of the tile
  settings.samples_per_pixel = 11;
  settings.seed = 5;
  return settings;
}

const Camera camera = look_at(Vec3(0, 0.5f, 2.9f), Vec3(0), 1.0f);

TEST(Render, IsBitIdenticalForAnyNumberOfThreads) {
  const Stage stage = small_stage();
  RenderSettings settings = small_settings();
  settings.threads = 1;
  const RenderResult one = render(stage.context(), camera, settings);
  EXPECT_EQ(one.film.sample_count(), 11u);
  EXPECT_GT(one.film.mean().pixels[0], 0);
  for (const int threads : {2, 7}) {
    settings.threads = threads;
    const RenderResult many = render(stage.context(), camera, settings);
    EXPECT_EQ(many.film.mean().pixels, one.film.mean().pixels) << threads << " threads";
    EXPECT_EQ(many.film.variance().pixels, one.film.variance().pixels) << threads << " threads";
    EXPECT_EQ(many.rays.total(), one.rays.total());
  }
}

TEST(Render, SeedChangesTheNoise) {
  const Stage stage = small_stage();
  RenderSettings settings = small_settings();
  const RenderResult first = render(stage.context(), camera, settings);
  settings.seed = 6;
  const RenderResult second = render(stage.context(), camera, settings);
  EXPECT_NE(first.film.mean().pixels, second.film.mean().pixels);
}

// A stop before the first sample still leaves a whole picture of one sample per pixel.
TEST(Render, StopLeavesAWholePicture) {
  const Stage stage = small_stage();
  const std::atomic<bool> stop{true};
  RenderSettings settings = small_settings();
  std::atomic<bool> is_late_stop{false};
  settings.samples_per_pixel = 1u << 20;
  const auto stop_after_eight = [&](const RenderProgress& progress) { is_late_stop = progress.samples_done >= 8; };
  const RenderResult result = render(stage.context(), camera, settings, stop_after_eight, &is_late_stop);
  EXPECT_TRUE(result.was_interrupted);
  EXPECT_GE(result.film.sample_count(), 8u);
  EXPECT_LT(result.film.sample_count(), 1u << 20);
  // What is there is what a render of that many samples would have been.
  settings.samples_per_pixel = result.film.sample_count();
  const RenderResult whole = render(stage.context(), camera, settings);
  EXPECT_EQ(result.film.mean().pixels, whole.film.mean().pixels);
  // The first sample of every pixel is finished even when the stop comes before it.
  EXPECT_EQ(render(stage.context(), camera, settings, {}, &stop).film.sample_count(), 1u);
}

TEST(Render, TimeLimitEndsTheRender) {
  const Stage stage = small_stage();
  RenderSettings settings = small_settings();
  settings.samples_per_pixel = 1u << 24;
  settings.time_limit_seconds = 0.2;
  const RenderResult result = render(stage.context(), camera, settings);
  EXPECT_TRUE(result.was_out_of_time);
  EXPECT_GE(result.film.sample_count(), 1u);
  EXPECT_LT(result.seconds, 5);
}

TEST(Render, TransparentBackgroundHasAlphaZero) {
  SceneBuilder builder;
  builder.scene.environment.tint = Vec3(1, 2, 3);
  builder.add_quad(Vec3(-10, -1, 0), Vec3(20, 0, 0), Vec3(0, 1, 0), builder.add_diffuse(Vec3(0.5f)));
  const Stage stage(builder.scene);
  RenderSettings settings = small_settings();
  settings.filter = FilterKind::box;
  const RenderResult opaque = render(stage.context(), camera, settings);
  settings.transparent_background = true;
  const RenderResult transparent = render(stage.context(), camera, settings);
  const Image before = opaque.film.mean(), after = transparent.film.mean();
  const float* sky = before.pixel(5, 0);
  EXPECT_NEAR(sky[0], 1, 1e-5f);
  EXPECT_NEAR(sky[2], 3, 1e-5f);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(after.pixel(5, 0)[c], 0);
  const int row = settings.height / 2 + 2;  // on the quad
  EXPECT_EQ(after.pixel(22, row)[3], 1);
  EXPECT_EQ(after.pixel(22, row)[0], before.pixel(22, row)[0]);
}

}  // namespace
}  // namespace candil::test
