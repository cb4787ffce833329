// Watertightness of every kind of accelerator: from inside of a closed surface every ray hits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/support/accelerator_cases.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

/// Per test; CANDIL_LEAK_RAYS asks for more.
std::size_t wanted_rays() {
  const char* const text = std::getenv("CANDIL_LEAK_RAYS");
  return text ? std::strtoull(text, nullptr, 10) : 300000;
}

/// For the slow ones fewer of them, so that they take no longer than the others.
std::size_t ray_count(const AcceleratorChoice& choice, const Mesh& mesh) {
  if (choice.kind == AcceleratorKind::brute)
    return std::min<std::size_t>(wanted_rays(), 30'000'000 / mesh.triangles.size());
  return choice.kind == AcceleratorKind::report ? wanted_rays() / 10 : wanted_rays();
}

/// Embree's edge functions may all say at a vertex that the ray is beyond it: of the rays that aim at one exactly, a
/// few in a thousand slip through.
double leak_share_at_vertices(const AcceleratorChoice& choice) {
  return choice.kind == AcceleratorKind::embree ? 0.01 : 0;
}

/// How many of the rays do not hit.
class LeakCounter {
 public:
  LeakCounter(const AcceleratorChoice& choice, const Mesh& mesh, const Affine& to_world, bool is_instanced) {
    SceneBuilder builder;
    builder.add_mesh(mesh, builder.add_diffuse(Vec3(0.5f)));
    Instance& instance = builder.scene.instances[0];
    if (is_instanced) {
      instance.to_world = to_world, instance.is_world_space = false;
    } else {
      for (Vec3& p : builder.scene.meshes[0].positions) p = to_world.point(p);
    }
    scene_ = builder.scene;
    accelerator_ = make_accelerator_of(choice, scene_);
  }
  void shoot(Vec3 origin, Vec3 towards) {
    const Ray ray{origin, glm::normalize(towards)};
    count_ += !accelerator_->intersect(ray) || !accelerator_->occluded(ray);
  }
  std::size_t count() const { return count_; }

 private:
  Scene scene_;
  std::unique_ptr<Accelerator> accelerator_;
  std::size_t count_ = 0;
};

struct Placing {
  const char* name;
  Affine to_world;
  bool is_instanced;
};

const Mat3 odd_linear(Vec3(-3, 0.5f, 0), Vec3(0.2f, 1, 0.1f), Vec3(0, 0, 2));  // mirrors, stretches and shears

const std::vector<Placing> placings = {
    {"as_it_is", Affine{}, false},
    {"odd", {odd_linear, Vec3(10, -20, 30)}, false},
    {"odd_instance", {odd_linear, Vec3(10, -20, 30)}, true},
    {"huge", {1e9f * odd_linear, Vec3(0)}, false},
    {"tiny", {1e-6f * odd_linear, Vec3(0)}, false},
    {"far", {odd_linear, Vec3(3e3f, -2e3f, 5e3f)}, false},
    {"tiny_instance", {1e-6f * odd_linear, Vec3(1e-4f)}, true},
};

class ClosedSurface : public testing::TestWithParam<std::tuple<AcceleratorChoice, Placing>> {};

// Rays in random directions and at points of edges, and in a second count those at vertices.
TEST_P(ClosedSurface, OfABallHasNoHoles) {
  const auto& [choice, placing] = GetParam();
  const Mesh ball = closed_ball(40);
  const Affine& to_world = placing.to_world;
  LeakCounter leaks(choice, ball, to_world, placing.is_instanced),
      at_vertices(choice, ball, to_world, placing.is_instanced);
  Random random(6);
  const std::size_t rays = ray_count(choice, ball);
  for (std::size_t i = 0; i < rays; ++i) {
    const Vec3 origin = to_world.point(0.5f * random_in_cube(random));  // the ball's inscribed radius is above 0.99
    const Triangle t = ball.triangles[random_index(random, 0, ball.triangles.size())];
    const Vec3 a = to_world.point(ball.positions[t.x]), b = to_world.point(ball.positions[t.y]);
    const float along = glm::mix(0.001f, 0.999f, random.next_1d());
    switch (i % 3) {
      case 0:
        leaks.shoot(origin, random_direction(random));
        break;
      case 1:
        leaks.shoot(origin, glm::mix(a, b, along) - origin);
        break;
      default:
        at_vertices.shoot(origin, a - origin);
    }
  }
  EXPECT_EQ(leaks.count(), 0u);
  EXPECT_LE(static_cast<double>(at_vertices.count()), leak_share_at_vertices(choice) * static_cast<double>(rays));
}

std::string closed_surface_name(const testing::TestParamInfo<ClosedSurface::ParamType>& test) {
  return std::get<0>(test.param).name() + "_" + std::get<1>(test.param).name;
}

INSTANTIATE_TEST_SUITE_P(All, ClosedSurface,
                         testing::Combine(testing::ValuesIn(accelerator_choices()), testing::ValuesIn(placings)),
                         closed_surface_name);

class ClosedBox : public testing::TestWithParam<AcceleratorChoice> {};

// A box of squares, all of whose corners are exact numbers. Rays along the axes and in the planes of the grid run in
// the faces of boxes of the hierarchy and end in corners and on edges of triangles.
TEST_P(ClosedBox, HasNoHolesAlongItsGrid) {
  constexpr int n = 8;
  const Mesh box = closed_box(Vec3(1), n);
  LeakCounter leaks(GetParam(), box, Affine{}, false);
  Random random(7);
  const std::size_t rays = ray_count(GetParam(), box);
  for (std::size_t i = 0; i < rays; ++i) {
    const auto on_grid = [&] {
      return Vec3(random_index(random, 1, n), random_index(random, 1, n), random_index(random, 1, n)) * (2.0f / n) -
             1.0f;
    };
    const Vec3 origin = on_grid();
    Vec3 towards(0);
    const auto axis = static_cast<int>(i % 3);
    if (i % 4 == 0) {
      towards[axis] = random.next_1d() < 0.5f ? 1.0f : -1.0f;
    } else if (i % 4 == 1) {
      towards = random_direction(random), towards[axis] = random.next_1d() < 0.5f ? 0.0f : -0.0f;
    } else {
      towards = on_grid() - origin;  // often diagonals, exactly through corners
      if (towards == Vec3(0)) continue;
    }
    leaks.shoot(origin, towards);
  }
  EXPECT_LE(static_cast<double>(leaks.count()), leak_share_at_vertices(GetParam()) * static_cast<double>(rays));
}

// Long triangles, and origins close to their edges compared to their length: what the places of vertices are rounded
// by is far more than the rounding of the ray's distance from the edge. Rays pass the edge within that.
TEST_P(ClosedBox, HasNoHolesAlongLongEdges) {
  const float c = std::cos(0.3f), s = std::sin(0.3f);
  const Mat3 turned(Vec3(c, s, 0), Vec3(-s, c, 0), Vec3(0, 0, 1));
  const Mesh box = closed_box(Vec3(1, 1, 1000), 1);
  for (const bool is_turned : {false, true}) {
    const Affine to_world{is_turned ? turned : Mat3(1), Vec3(0)};
    LeakCounter leaks(GetParam(), box, to_world, false);
    Random random(8);
    const std::size_t rays = ray_count(GetParam(), box);
    for (std::size_t i = 0; i < rays; ++i) {
      const float sx = random.next_1d() < 0.5f ? -1.0f : 1.0f, sy = random.next_1d() < 0.5f ? -1.0f : 1.0f;
      const float near = std::pow(10.0f, -4 * random.next_1d());  // 1e-4 to 1 off the edge
      const Vec3 origin(sx * (1 - 0.5f * near * (1 + random.next_1d())),
                        sy * (1 - 0.5f * near * (1 + random.next_1d())), 1800 * (random.next_1d() - 0.5f));
      const Vec3 on_edge(sx, sy, origin.z + 2 * near * (random.next_1d() - 0.5f));
      const Vec3 beside = near * std::pow(10.0f, -7 * random.next_1d()) * random_in_cube(random);
      leaks.shoot(to_world.point(origin), to_world.vector(on_edge + beside - origin));
    }
    EXPECT_EQ(leaks.count(), 0u) << (is_turned ? "turned" : "along the axis");
  }
}

INSTANTIATE_TEST_SUITE_P(All, ClosedBox, testing::ValuesIn(accelerator_choices()), choice_name);

}  // namespace
}  // namespace candil::test
