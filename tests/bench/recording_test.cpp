#include "bench/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "tests/bench/test_scenes.h"

namespace candil::test {
namespace {

constexpr std::size_t no_limit = std::size_t{1} << 30;

/// Keeps what a render on one thread shoots.
class Witness final : public Accelerator {
 public:
  explicit Witness(const Accelerator& inner) : inner_(inner) {}
  std::optional<Hit> intersect(const Ray& ray) const override {
    nearest.push_back(ray);
    return inner_.intersect(ray);
  }
  bool occluded(const Ray& ray) const override {
    shadow.push_back(ray);
    return inner_.occluded(ray);
  }
  std::size_t memory_bytes() const override { return 0; }

  mutable std::vector<Ray> nearest, shadow;

 private:
  const Accelerator& inner_;
};

using RayBits = std::array<std::uint32_t, 7>;

std::vector<RayBits> sorted_bits(const std::vector<Ray>& rays) {
  static_assert(sizeof(Ray) == sizeof(RayBits));
  std::vector<RayBits> result(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) std::memcpy(&result[i], &rays[i], sizeof(Ray));
  std::ranges::sort(result);
  return result;
}

TEST(Recording, HasExactlyTheRaysOfTheRender) {
  const Stage stage(lit_room());
  const RenderSettings settings = small_settings();
  const Witness witness(stage.accelerator());
  const RenderContext context = stage.context();
  render({context.scene, witness, context.lights, context.tables}, room_camera(), settings);
  const Recording recording = record_rays(context, room_camera(), settings, no_limit);
  std::vector<Ray> nearest;
  for (const RayKind kind : {RayKind::primary, RayKind::first_bounce, RayKind::deeper_bounces})
    nearest.insert(nearest.end(), recording.rays[kind].begin(), recording.rays[kind].end());
  EXPECT_GT(nearest.size(), 2u * 40 * 24 * 3);
  EXPECT_EQ(sorted_bits(nearest), sorted_bits(witness.nearest));
  EXPECT_EQ(sorted_bits(recording.rays[RayKind::shadow]), sorted_bits(witness.shadow));
}

TEST(Recording, TellsBouncesApart) {
  const Stage stage(lit_room());
  RenderSettings settings = small_settings();
  const Recording recording = record_rays(stage.context(), room_camera(), settings, no_limit);
  const RayCounts all = render(stage.context(), room_camera(), settings).rays;
  settings.max_bounces = 1;  // the rays of the first bounce are the last
  const RayCounts one = render(stage.context(), room_camera(), settings).rays;
  EXPECT_EQ(recording.rays[RayKind::primary].size(), all.camera);
  EXPECT_EQ(recording.rays[RayKind::first_bounce].size(), one.bounce);
  EXPECT_EQ(recording.rays[RayKind::deeper_bounces].size(), all.bounce - one.bounce);
  EXPECT_GT(all.bounce, one.bounce);
  EXPECT_EQ(recording.rays[RayKind::shadow].size(), all.shadow);
  EXPECT_EQ(recording.paths, 40u * 24 * 3);
  EXPECT_EQ(recording.paths_wanted, recording.paths);
}

// 64 x 64 pixels, room for about a tenth of the paths: whole ones, and not only from the top of the picture.
TEST(Recording, LeavesPathsOutEvenlyWhenMemoryEnds) {
  const Stage stage(lit_room());
  RenderSettings settings = small_settings();
  settings.width = settings.height = 96;
  settings.samples_per_pixel = 1;
  const std::size_t all = record_rays(stage.context(), room_camera(), settings, no_limit).bytes();
  const std::size_t limit = all / 4;
  const Recording recording = record_rays(stage.context(), room_camera(), settings, limit);
  EXPECT_LE(recording.bytes(), limit);
  EXPECT_GT(recording.bytes(), limit * 9 / 10);
  EXPECT_EQ(recording.rays[RayKind::primary].size(), recording.paths);
  EXPECT_EQ(recording.paths_wanted, 96u * 96);
  EXPECT_LT(recording.paths, recording.paths_wanted / 2);
  // Of 36 tiles about 9 fit. Upper and lower half of the picture: each gets 3 of them at the least.
  const auto upper =
      std::ranges::count_if(recording.rays[RayKind::primary], [](const Ray& ray) { return ray.direction.y > -0.04f; });
  EXPECT_GT(upper, 3 * 200);
  EXPECT_GT(static_cast<std::ptrdiff_t>(recording.paths) - upper, 3 * 200);
}

TEST(Recording, OfNoMemoryIsEmpty) {
  const Stage stage(lit_room());
  const Recording recording = record_rays(stage.context(), room_camera(), small_settings(), 0);
  EXPECT_EQ(recording.paths, 0u);
  EXPECT_EQ(recording.ray_count(), 0u);
}

}  // namespace
}  // namespace candil::test
