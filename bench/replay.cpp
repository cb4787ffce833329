#include "bench/replay.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>

#include "core/accelerator.h"
#include "core/denormals.h"

namespace candil {
namespace {

/// More than the renderer asks for at once, so that no accelerator has a reason to want more.
constexpr std::size_t rays_at_once = 64;

std::uint64_t count_hits(const Accelerator& accelerator, std::span<const Ray> rays) {
  std::uint64_t count = 0;
  std::array<Hit, rays_at_once> hits;
  for (std::size_t first = 0; first < rays.size(); first += rays_at_once) {
    const auto some = rays.subspan(first, std::min(rays_at_once, rays.size() - first));
    const auto answers = std::span(hits).first(some.size());
    accelerator.intersect_each(some, answers);
    for (const Hit& hit : answers) count += !hit.is_miss();
  }
  return count;
}

std::uint64_t count_occluded(const Accelerator& accelerator, std::span<const Ray> rays) {
  std::uint64_t count = 0;
  for (const Ray& ray : rays) count += accelerator.occluded(ray);
  return count;
}

}  // namespace

Shoot shoot_through(const Accelerator& accelerator, RayKind kind) {
  if (kind == RayKind::shadow) return [&](std::span<const Ray> rays) { return count_occluded(accelerator, rays); };
  return [&](std::span<const Ray> rays) { return count_hits(accelerator, rays); };
}

std::size_t RayChoice::block_count() const {
  const std::size_t blocks = (rays.size() + replay_block_size - 1) / replay_block_size;
  return (blocks + stride - 1) / stride;
}

std::span<const Ray> RayChoice::block(std::size_t i) const {
  const std::size_t first = i * stride * replay_block_size;
  return rays.subspan(first, std::min(replay_block_size, rays.size() - first));
}

std::size_t RayChoice::ray_count() const {
  const std::size_t blocks = block_count();
  return blocks == 0 ? 0 : (blocks - 1) * replay_block_size + block(blocks - 1).size();
}

Replay replay(const RayChoice& choice, int threads, const Shoot& shoot) {
  std::atomic<std::uint64_t> hits{0};
  double seconds = 0;
  on_threads(threads, [&] {
    seconds = seconds_of([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, choice.block_count()), [&](const auto& range) {
        const DenormalsAreZero denormals_are_zero;
        std::uint64_t found = 0;
        for (std::size_t i = range.begin(); i < range.end(); ++i) found += shoot(choice.block(i));
        hits += found;
      });
    });
  });
  return {seconds, hits};
}

RayChoice choose_rays(std::span<const Ray> rays, double longest_seconds, int threads, const Shoot& shoot) {
  const std::size_t blocks = RayChoice{rays}.block_count();
  // First one block, then more of them until the time says something about all.
  for (std::size_t tried = 1; tried < blocks; tried *= 4) {
    const RayChoice some{rays, (blocks + tried - 1) / tried};
    const double seconds = replay(some, threads, shoot).seconds;
    const double expected = seconds * static_cast<double>(blocks) / static_cast<double>(some.block_count());
    if (seconds < 0.1 * longest_seconds) continue;
    if (expected <= longest_seconds) break;
    return {rays, std::min(blocks, static_cast<std::size_t>(std::ceil(expected / longest_seconds)))};
  }
  return {rays};
}

void on_threads(int threads, const std::function<void()>& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace candil
