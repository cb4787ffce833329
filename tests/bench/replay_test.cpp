#include "bench/replay.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace candil::test {
namespace {

/// Each with its number as t_max.
std::vector<Ray> numbered_rays(std::size_t count) {
  std::vector<Ray> rays(count);
  for (std::size_t i = 0; i < count; ++i) rays[i].t_max = static_cast<float>(i);
  return rays;
}

TEST(RayChoice, OfStrideOneHasEveryRayOnce) {
  const std::vector<Ray> rays = numbered_rays(4 * replay_block_size + 7);
  const RayChoice all{rays};
  ASSERT_EQ(all.block_count(), 5u);
  EXPECT_EQ(all.ray_count(), rays.size());
  std::size_t next = 0;
  for (std::size_t b = 0; b < all.block_count(); ++b)
    for (const Ray& ray : all.block(b)) EXPECT_EQ(ray.t_max, static_cast<float>(next++));
  EXPECT_EQ(next, rays.size());
}

TEST(RayChoice, OfALargerStrideHasWholeBlocksFromAllOver) {
  const std::vector<Ray> rays = numbered_rays(4 * replay_block_size + 7);
  const RayChoice some{rays, 2};  // blocks 0, 2, and 4 with its 7 rays
  ASSERT_EQ(some.block_count(), 3u);
  EXPECT_EQ(some.ray_count(), 2 * replay_block_size + 7);
  EXPECT_EQ(some.block(1).front().t_max, static_cast<float>(2 * replay_block_size));
  EXPECT_EQ(some.block(2).size(), 7u);
}

TEST(RayChoice, OfNothingIsEmpty) {
  EXPECT_EQ(RayChoice{}.block_count(), 0u);
  EXPECT_EQ(RayChoice{}.ray_count(), 0u);
}

TEST(Replay, ShootsEveryRayOnceWithAnyNumberOfThreads) {
  const std::vector<Ray> rays = numbered_rays(50 * replay_block_size + 3);
  for (const int threads : {1, 3}) {
    std::vector<std::atomic<int>> shots(rays.size());
    const Replay result = replay({rays}, threads, [&](std::span<const Ray> some) {
      for (const Ray& ray : some) ++shots[static_cast<std::size_t>(ray.t_max)];
      return some.size();
    });
    EXPECT_EQ(result.hits, rays.size());
    EXPECT_GT(result.seconds, 0);
    for (const auto& count : shots) ASSERT_EQ(count, 1);
  }
}

TEST(Replay, UsesTheThreadsItIsGiven) {
  const std::vector<Ray> rays = numbered_rays(200 * replay_block_size);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  const auto shoot = [&](std::span<const Ray>) -> std::uint64_t {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::scoped_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
    return 0;
  };
  replay({rays}, 1, shoot);
  EXPECT_EQ(threads.size(), 1u);
  replay({rays}, 2, shoot);
  EXPECT_EQ(threads.size(), 2u);
}

TEST(ChooseRays, TakesAllWhereThereIsTime) {
  const std::vector<Ray> rays = numbered_rays(20 * replay_block_size);
  EXPECT_EQ(choose_rays(rays, 100, 1, [](auto some) { return some.size(); }).stride, 1u);
  EXPECT_EQ(choose_rays({}, 100, 1, [](auto some) { return some.size(); }).ray_count(), 0u);
}

// 64 blocks of at least 2 ms each are 128 ms or more: of 20 ms there is room for every seventh at the most.
TEST(ChooseRays, TakesAPartWhereThereIsNot) {
  const std::vector<Ray> rays = numbered_rays(64 * replay_block_size);
  const RayChoice choice = choose_rays(rays, 0.020, 1, [](auto some) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return some.size();
  });
  EXPECT_GE(choice.stride, 7u);
  EXPECT_GE(choice.block_count(), 1u);
}

}  // namespace
}  // namespace candil::test
