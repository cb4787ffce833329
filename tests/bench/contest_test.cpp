#include "bench/contest.h"

#include <gtest/gtest.h>

#include "bench/bare_embree.h"
#include "bench/instance_memory.h"
#include "materials/alpha.h"
#include "tests/bench/test_scenes.h"

namespace candil::test {
namespace {

/// Blind on the right-hand side.
class HalfBlind final : public Accelerator {
 public:
  explicit HalfBlind(const Scene& scene) : inner_(make_accelerator(scene, alpha_filter())) {}
  std::optional<Hit> intersect(const Ray& ray) const override {
    if (ray.direction.x > 0) return std::nullopt;
    return inner_->intersect(ray);
  }
  bool occluded(const Ray& ray) const override { return ray.direction.x <= 0 && inner_->occluded(ray); }
  std::size_t memory_bytes() const override { return inner_->memory_bytes(); }

 private:
  std::unique_ptr<Accelerator> inner_;
};

ContestSettings quick_settings() {
  ContestSettings settings;
  settings.threads = {1, 2};
  settings.repetitions = 2;
  return settings;
}

const std::size_t enough_memory = std::size_t{64} << 20;

void expect_ordered(const Spread& spread) {
  EXPECT_GT(spread.min, 0);
  EXPECT_LE(spread.min, spread.median);
  EXPECT_LE(spread.median, spread.max);
}

TEST(Contest, MeasuresEveryContestantWithEveryNumberOfThreads) {
  const Scene scene = lit_room();
  AcceleratorOptions compact;
  compact.is_compact = true;
  const ContestResult result = run_contest(scene, room_camera(), small_settings(), enough_memory,
                                           {make_contestant("a", {}), make_contestant("b", compact)}, quick_settings());
  EXPECT_EQ(result.paths, 40u * 24 * 3);
  ASSERT_EQ(result.contestants.size(), 2u);
  EXPECT_EQ(result.contestants[1].name, "b");
  EXPECT_FALSE(result.has_mismatch());
  for (const ContestantResult& contestant : result.contestants) {
    EXPECT_GT(contestant.memory_bytes, 1000u);
    EXPECT_GT(contestant.bytes_per_instance.value(), 64);  // a matrix and some
    ASSERT_EQ(contestant.build_seconds.size(), 2u);
    ASSERT_EQ(contestant.rates.size(), 2u);
    for (std::size_t t = 0; t < 2; ++t) {
      expect_ordered(contestant.build_seconds[t]);
      for (const RayKind kind : ray_kinds) {
        EXPECT_EQ(contestant.rates[t][kind].rays, result.rays[kind]);
        expect_ordered(contestant.rates[t][kind].rays_per_second);
        expect_ordered(contestant.rates[t][kind].ratio);
      }
    }
  }
  for (const RayKind kind : ray_kinds) {
    EXPECT_EQ(result.contestants[0].rates[0][kind].ratio.median, 1);
    EXPECT_EQ(result.contestants[0].agreement[kind].rays, 0u);
    EXPECT_EQ(result.contestants[1].agreement[kind].rays, result.rays[kind]);
  }
  ASSERT_EQ(result.overhead.size(), 2u);
  for (const RenderOverhead& overhead : result.overhead) {
    expect_ordered(overhead.rays_per_second);
    // Below 1 on a quiet machine, which tests do not have.
    EXPECT_GT(overhead.total.median, 0);
    EXPECT_GT(overhead.primary.median, 0);
  }
}

TEST(Contest, FindsAWrongContestant) {
  const Scene scene = lit_room();
  const Contestant blind{"blind", [](const Scene& s) { return std::make_unique<HalfBlind>(s); }};
  const ContestResult result = run_contest(scene, room_camera(), small_settings(), enough_memory,
                                           {make_contestant("embree", {}), blind}, quick_settings());
  EXPECT_TRUE(result.has_mismatch());
  const Agreement& primary = result.contestants[1].agreement[RayKind::primary];
  // Nearly half of the picture: what is not empty there.
  EXPECT_GT(primary.mismatches, primary.rays / 4);
  EXPECT_LT(primary.mismatches, primary.rays * 6 / 10);
  ASSERT_TRUE(primary.first_mismatch);
  EXPECT_GT(primary.first_mismatch->ray.direction.x, 0);
}

TEST(Contest, GivesSlowContestantsAPartOfTheRays) {
  const Scene scene = lit_room();
  ContestSettings settings = quick_settings();
  settings.longest_replay_seconds = 1e-5;  // nobody shoots a block in that time
  const ContestResult result =
      run_contest(scene, room_camera(), small_settings(), enough_memory, {make_contestant("embree", {})}, settings);
  EXPECT_LE(result.contestants[0].rates[0][RayKind::primary].rays, 2u * 1024);
  EXPECT_GT(result.rays[RayKind::primary], 2u * 1024);
}

TEST(Contest, SurvivesAnEmptyScene) {
  const Scene scene;
  const ContestResult result = run_contest(scene, room_camera(), small_settings(), enough_memory,
                                           {make_contestant("embree", {})}, quick_settings());
  EXPECT_EQ(result.rays[RayKind::primary], 40u * 24 * 3);
  EXPECT_EQ(result.rays[RayKind::first_bounce], 0u);
  EXPECT_FALSE(result.has_mismatch());
}

TEST(BareEmbree, HitsWhatTheAcceleratorHits) {
  Scene scene = lit_room();
  EXPECT_FALSE(BareEmbree::make(scene)) << "there is a sphere";
  scene.shapes.clear();
  const std::optional<BareEmbree> bare = BareEmbree::make(scene);
  ASSERT_TRUE(bare);
  const Stage stage(scene);
  const Recording recording = record_rays(stage.context(), room_camera(), small_settings(), enough_memory);
  for (const RayKind kind : ray_kinds) {
    std::uint64_t hits = 0;
    for (const Ray& ray : recording.rays[kind]) {
      hits +=
          kind == RayKind::shadow ? stage.accelerator().occluded(ray) : stage.accelerator().intersect(ray).has_value();
    }
    EXPECT_GT(hits, 0u);
    EXPECT_EQ(bare->shoot(recording.rays[kind], kind), hits) << ray_kind_name(kind);
  }
}

class MemoryCount final : public Accelerator {
 public:
  explicit MemoryCount(std::size_t bytes) : bytes_(bytes) {}
  std::optional<Hit> intersect(const Ray&) const override { return std::nullopt; }
  bool occluded(const Ray&) const override { return false; }
  std::size_t memory_bytes() const override { return bytes_; }

 private:
  std::size_t bytes_;
};

// 1000 bytes for all that is shared, 100 for each instance.
TEST(InstanceMemory, IsWhatAFurtherInstanceCosts) {
  const auto make = [](const Scene& scene) {
    return std::make_unique<MemoryCount>(1000 + 100 * scene.instances.size());
  };
  Scene scene = lit_room();
  EXPECT_EQ(bytes_per_instance(scene, *make(scene), make), 100);
  scene.instances.pop_back();
  EXPECT_FALSE(bytes_per_instance(scene, *make(scene), make));
}

}  // namespace
}  // namespace candil::test
