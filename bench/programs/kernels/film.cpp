// Sums of samples: within a pixel, and over blocks. Rates are samples and pixels per second.
#include <benchmark/benchmark.h>

#include "core/film.h"

namespace candil {
namespace {

void sum_of_pixel(benchmark::State& state) {
  const auto samples = static_cast<std::uint32_t>(state.range(0));
  const PixelSums sample{Vec3(0.5f), 1, Vec3(0.25f)};
  for ([[maybe_unused]] auto _ : state) {
    PairwiseSum<PixelSums> sum;
    for (std::uint32_t i = 0; i < samples; ++i) sum.add(sample);
    PixelSums total = sum.total();
    benchmark::DoNotOptimize(total);
  }
  state.SetItemsProcessed(state.iterations() * samples);
}
BENCHMARK(sum_of_pixel)->Name("film/samples of a pixel")->Arg(1)->Arg(16);

constexpr int side = 256;

void add_block(benchmark::State& state) {
  Film film(side, side);
  for ([[maybe_unused]] auto _ : state) {
    film.begin_block();
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) film.block_pixel(x, y) = {Vec3(0.5f), 1, Vec3(0.25f)};
    film.end_block(1);
  }
  state.SetItemsProcessed(state.iterations() * side * side);
}
BENCHMARK(add_block)->Name("film/blocks of pixels");

void mean(benchmark::State& state) {
  Film film(side, side);
  for (int i = 0; i < 3; ++i) {
    film.begin_block();
    film.end_block(1);
  }
  for ([[maybe_unused]] auto _ : state) {
    Image image = film.mean();
    benchmark::DoNotOptimize(image.pixels.data());
  }
  state.SetItemsProcessed(state.iterations() * side * side);
}
BENCHMARK(mean)->Name("film/mean of pixels");

}  // namespace
}  // namespace candil
