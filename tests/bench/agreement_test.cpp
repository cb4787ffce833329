#include "bench/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "materials/alpha.h"
#include "tests/bench/test_scenes.h"

namespace candil::test {
namespace {

/// Answers like another accelerator, but for a mistake.
class Mistaken final : public Accelerator {
 public:
  using Change = std::function<void(const Ray&, std::optional<Hit>&)>;

  Mistaken(const Accelerator& inner, Change change) : inner_(inner), change_(std::move(change)) {}
  std::optional<Hit> intersect(const Ray& ray) const override {
    std::optional<Hit> hit = inner_.intersect(ray);
    change_(ray, hit);
    return hit;
  }
  bool occluded(const Ray& ray) const override { return intersect(ray).has_value(); }
  std::size_t memory_bytes() const override { return 0; }

 private:
  const Accelerator& inner_;
  Change change_;
};

class AgreementTest : public testing::Test {
 protected:
  AgreementTest()
      : stage_(lit_room()),
        recording_(record_rays(stage_.context(), room_camera(), small_settings(), std::size_t{1} << 30)) {}

  Agreement compare_with(const Accelerator& other, RayKind kind) const {
    return compare(stage_.scene(), stage_.accelerator(), other, {recording_.rays[kind]}, kind, 2);
  }
  Agreement compare_with(const Mistaken::Change& change, RayKind kind) const {
    return compare_with(Mistaken(stage_.accelerator(), change), kind);
  }
  std::size_t count(RayKind kind) const { return recording_.rays[kind].size(); }

  Stage stage_;
  Recording recording_;
};

TEST_F(AgreementTest, IsCompleteWithItself) {
  for (const RayKind kind : ray_kinds) {
    const Agreement result = compare_with(stage_.accelerator(), kind);
    EXPECT_EQ(result.rays, count(kind));
    EXPECT_EQ(result.ties, 0u);
    EXPECT_EQ(result.mismatches, 0u);
    EXPECT_FALSE(result.first_mismatch);
  }
}

TEST_F(AgreementTest, OfEmbreesKernelsIsCompleteButForTies) {
  AcceleratorOptions options;
  options.isa = "sse4.2", options.quality = BuildQuality::low;
  const auto other = make_accelerator(stage_.scene(), alpha_filter(), options);
  for (const RayKind kind : ray_kinds) {
    const Agreement result = compare_with(*other, kind);
    EXPECT_EQ(result.mismatches, 0u) << ray_kind_name(kind);
    EXPECT_LT(result.ties, result.rays / 100);
  }
}

// 2^-19 of a hit some 5 m away is ten times what float arithmetic may do there: 2^-20 of coordinates up to 5 m times
// the slope of the surface to the ray, which is steep for few rays only.
TEST_F(AgreementTest, FindsDistancesThatAreOff) {
  const Agreement result = compare_with(
      [](const Ray&, std::optional<Hit>& hit) {
        if (hit) hit->t *= 1 + 0x1p-15f;
      },
      RayKind::primary);
  EXPECT_GT(result.mismatches, count(RayKind::primary) / 2);
  ASSERT_TRUE(result.first_mismatch);
  EXPECT_GT(result.first_mismatch->found.t, result.first_mismatch->expected.t);
}

TEST_F(AgreementTest, ForgivesRounding) {
  const Agreement result = compare_with(
      [](const Ray&, std::optional<Hit>& hit) {
        if (hit) hit->t = std::nextafter(hit->t, infinity);
      },
      RayKind::primary);
  EXPECT_EQ(result.mismatches, 0u);
  EXPECT_EQ(result.ties, 0u);
}

/// Every 20th ray, by a hash of its direction.
bool is_unlucky(const Ray& ray) { return std::fmod(std::abs(ray.direction.x) * 12345, 1.0f) < 0.05f; }

TEST_F(AgreementTest, FindsLeaks) {
  const auto leak = [](const Ray& ray, std::optional<Hit>& hit) {
    if (is_unlucky(ray)) hit.reset();
  };
  for (const RayKind kind : {RayKind::primary, RayKind::first_bounce, RayKind::shadow}) {
    std::uint64_t wrong = 0;
    for (const Ray& ray : recording_.rays[kind]) wrong += is_unlucky(ray) && stage_.accelerator().occluded(ray);
    ASSERT_GT(wrong, 2u);
    const Agreement result = compare_with(leak, kind);
    // A ray may pass an outline by chance, so that missing is as right.
    EXPECT_LE(result.mismatches, wrong) << ray_kind_name(kind);
    EXPECT_GE(result.mismatches + 1, wrong) << ray_kind_name(kind);
  }
}

TEST_F(AgreementTest, FindsHitsThatAreNotThere) {
  const Agreement result = compare_with(
      [](const Ray& ray, std::optional<Hit>& hit) {
        if (is_unlucky(ray)) hit = Hit{0.5f, Vec2(0.25f), 0, 0, 0};
      },
      RayKind::primary);
  EXPECT_GT(result.mismatches, 10u);
}

// The right distance, but another triangle, which is not there.
TEST_F(AgreementTest, FindsWrongPrimitives) {
  const Agreement result = compare_with(
      [](const Ray&, std::optional<Hit>& hit) {
        if (hit && hit->mesh == 3) hit->triangle = (hit->triangle + 200) % 1000;
      },
      RayKind::primary);
  EXPECT_GT(result.mismatches, 100u);
}

// The right triangle, but another place on it.
TEST_F(AgreementTest, FindsWrongPlaces) {
  const Agreement result = compare_with(
      [](const Ray&, std::optional<Hit>& hit) {
        if (hit) std::swap(hit->barycentric.x, hit->barycentric.y);
      },
      RayKind::primary);
  EXPECT_GT(result.mismatches, count(RayKind::primary) / 4);
}

TEST_F(AgreementTest, FindsBlockersThatAreNotThere) {
  const Agreement result = compare_with([](const Ray&, std::optional<Hit>& hit) { hit = Hit{}; }, RayKind::shadow);
  std::uint64_t free = 0;
  for (const Ray& ray : recording_.rays[RayKind::shadow]) free += !stage_.accelerator().occluded(ray);
  EXPECT_GT(free, 100u);
  // Seen from the reference, a few of them nearly start or end on a surface.
  EXPECT_GE(result.mismatches, free * 95 / 100);
  EXPECT_TRUE(result.first_mismatch->is_shadow);
  EXPECT_TRUE(result.first_mismatch->expected.is_miss());
  EXPECT_FALSE(result.first_mismatch->found.is_miss());
}

// Two squares in the same place: either may be the nearest.
TEST(Agreement, AcceptsEitherOfTwoSurfacesInOnePlace) {
  SceneBuilder builder;
  const std::uint32_t white = builder.add_diffuse(Vec3(0.5f));
  for (int i = 0; i < 2; ++i) builder.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, white);
  const Stage stage(std::move(builder.scene));
  const Mistaken other(stage.accelerator(), [](const Ray&, std::optional<Hit>& hit) {
    if (hit) hit->mesh = hit->instance = 1 - hit->mesh;
  });
  const std::vector<Ray> rays = {{{0.3f, 0.2f, 1}}, {{-0.4f, 0.1f, 2}}};
  const Agreement result = compare(stage.scene(), stage.accelerator(), other, {rays}, RayKind::primary, 1);
  EXPECT_EQ(result.ties, 2u);
  EXPECT_EQ(result.mismatches, 0u);
}

// Rays along the outline of a square: hit and miss are both right within a rounding error of it, and only there.
TEST(Agreement, AcceptsBothAnswersAtAnOutline) {
  SceneBuilder builder;
  builder.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, builder.add_diffuse(Vec3(0.5f)));
  const Stage stage(std::move(builder.scene));
  const Mistaken other(stage.accelerator(), [](const Ray&, std::optional<Hit>& hit) { hit.reset(); });
  const auto judge = [&](float x) {
    const std::vector<Ray> rays = {{{x, 0.3f, 1}}};
    return compare(stage.scene(), stage.accelerator(), other, {rays}, RayKind::primary, 1);
  };
  EXPECT_EQ(judge(1 - 0x1p-22f).ties, 1u);
  EXPECT_EQ(judge(1 - 0x1p-22f).mismatches, 0u);
  EXPECT_EQ(judge(1 - 0x1p-16f).mismatches, 1u);
  EXPECT_EQ(judge(0.2f).mismatches, 1u);
}

// A strip 2^-20 m wide, as an edge-on leaf seems to be: who moves a ray by a whole tolerance does not meet it again.
TEST(Agreement, AcceptsBothAnswersAtWhatIsThin) {
  SceneBuilder builder;
  const std::uint32_t white = builder.add_diffuse(Vec3(0.5f));
  builder.add_quad({0, -1, 0}, {0x1p-20f, 0, 0}, {0, 2, 0}, white);
  builder.add_quad({-9, -9, -8}, {18, 0, 0}, {0, 18, 0}, white);  // 8 m behind, so that the tolerance is 2^-17 m
  const Stage stage(std::move(builder.scene));
  const std::vector<Ray> rays = {{{-0x1p-21f, 0.3f, 1}}};
  const Mistaken other(stage.accelerator(), [](const Ray&, std::optional<Hit>& hit) {
    hit = Hit{1, {0.3f, 0.65f}, 0, 0, 0};  // y = -1 + 2 * 0.65
  });
  ASSERT_EQ(stage.accelerator().intersect(rays[0])->mesh, 1u);
  const Agreement result = compare(stage.scene(), stage.accelerator(), other, {rays}, RayKind::primary, 1);
  EXPECT_EQ(result.ties, 1u);
  EXPECT_EQ(result.mismatches, 0u);
}

}  // namespace
}  // namespace candil::test
