// Random numbers, and what makes camera rays of them.
#include <benchmark/benchmark.h>

#include "core/camera.h"
#include "core/pixel_filter.h"
#include "core/sampler.h"
#include "core/warp.h"

namespace candil {
namespace {

void sampler_of_pixel(benchmark::State& state) {
  std::uint32_t x = 0;
  for ([[maybe_unused]] auto _ : state) {
    Sampler sampler({x++, 3}, 0, 5);
    benchmark::DoNotOptimize(sampler);
  }
}
BENCHMARK(sampler_of_pixel)->Name("sampler/of a pixel");

void one_pair(benchmark::State& state) {
  const Sampler sampler({1, 2}, 0, 3);
  std::uint32_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    Vec2 u = sampler.at_sample(i++).sample_2d(2);
    benchmark::DoNotOptimize(u);
  }
}
BENCHMARK(one_pair)->Name("sampler/one pair");

void four_pairs(benchmark::State& state) {
  const Sampler sampler({1, 2}, 0, 3);
  std::uint32_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    FourPoints u = sampler.at_sample(i++).sample_four_2d(2);
    benchmark::DoNotOptimize(u);
  }
}
BENCHMARK(four_pairs)->Name("sampler/four pairs");

void hemisphere(benchmark::State& state) {
  Vec2 u(0.3f, 0.7f);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(u);
    Vec3 direction = sample_cosine_hemisphere(u);
    benchmark::DoNotOptimize(direction);
  }
}
BENCHMARK(hemisphere)->Name("sampler/cosine hemisphere");

void filter(benchmark::State& state) {
  const PixelFilter blackman_harris(FilterKind::blackman_harris);
  Vec2 u(0.3f, 0.7f);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(u);
    Vec2 offset = blackman_harris.sample(u);
    benchmark::DoNotOptimize(offset);
  }
}
BENCHMARK(filter)->Name("camera/pixel filter");

void camera_ray(benchmark::State& state, float lens_radius) {
  Camera camera = look_at({0, 1, 3}, {0, 0, 0}, 0.7f);
  camera.lens_radius = lens_radius;
  const CameraRays rays(camera, 640, 480);
  Vec2 pixel(320.5f, 100.25f), u_lens(0.3f, 0.6f);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(pixel);
    Ray ray = rays.ray(pixel, u_lens);
    benchmark::DoNotOptimize(ray);
  }
}
BENCHMARK_CAPTURE(camera_ray, pinhole, 0.0f)->Name("camera/ray of a pinhole");
BENCHMARK_CAPTURE(camera_ray, lens, 0.1f)->Name("camera/ray of a lens");

}  // namespace
}  // namespace candil
