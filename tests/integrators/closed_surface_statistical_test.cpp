// Ten million rays from inside of a closed surface: every one must hit.
#include <gtest/gtest.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cstdlib>
#include <functional>

#include "tests/support/accelerator_cases.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// Per accelerator; CANDIL_LEAK_RAYS asks for another number, of all of them. The slow ones get fewer.
std::size_t wanted_rays(const AcceleratorChoice& choice) {
  if (const char* const text = std::getenv("CANDIL_LEAK_RAYS")) return std::strtoull(text, nullptr, 10);
  const bool is_fast = choice.kind == AcceleratorKind::embree || choice.kind == AcceleratorKind::wide;
  return is_fast ? 10'000'000 : 1'000'000;
}

class TenMillionRays : public testing::TestWithParam<AcceleratorChoice> {};

// Half of them in random directions, half at points of edges. Without a hierarchy the ball has 48 triangles, otherwise
// 20,000.
TEST_P(TenMillionRays, AllHit) {
  const Mesh ball = closed_ball(GetParam().kind == AcceleratorKind::brute ? 4 : 71);
  SceneBuilder builder;
  builder.add_mesh(ball, builder.add_diffuse(Vec3(0.5f)));
  const auto accelerator = make_accelerator_of(GetParam(), builder.scene);
  constexpr std::size_t block = 4096;
  const std::size_t blocks = (wanted_rays(GetParam()) + block - 1) / block;
  const std::size_t leaks = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, blocks), std::size_t{0},
      [&](const auto& range, std::size_t count) {
        for (std::size_t b = range.begin(); b < range.end(); ++b) {
          Random random(static_cast<std::uint32_t>(b));
          for (std::size_t i = 0; i < block; ++i) {
            const Vec3 origin =
                0.4f * random_in_cube(random);  // 0.7 from the centre at most; the ball's faces are 0.8 off
            Vec3 direction = random_direction(random);
            if (i % 2 == 1) {
              const Triangle t = ball.triangles[random_index(random, 0, ball.triangles.size())];
              const Vec3 at = glm::mix(ball.positions[t.x], ball.positions[t.y], random.next_1d());
              direction = glm::normalize(at - origin);
            }
            const Ray ray{origin, direction};
            count += !accelerator->intersect(ray) || !accelerator->occluded(ray);
          }
        }
        return count;
      },
      std::plus<>());
  EXPECT_EQ(leaks, 0u) << "of " << blocks * block;
}

INSTANTIATE_TEST_SUITE_P(All, TenMillionRays, testing::ValuesIn(accelerator_choices()), choice_name);

}  // namespace
}  // namespace candil::test
