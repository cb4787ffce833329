// The watertight triangle test, one by one and in groups, and the boxes around it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/bvh/box_test.h"
#include "core/bvh/node_pair.h"
#include "core/bvh/triangle_group.h"
#include "core/bvh/triangle_test.h"
#include "tests/support/accelerator_cases.h"

namespace candil::test {
namespace {

struct Corners {
  Vec3 a, b, c;
};

Corners random_triangle(Random& random, float size) {
  const Vec3 center = random_in_cube(random);
  return {center + size * random_in_cube(random), center + size * random_in_cube(random),
          center + size * random_in_cube(random)};
}

/// A number whose magnitude is anywhere between 10^low and 10^high.
float random_magnitude(Random& random, float low, float high) {
  return std::pow(10.0f, glm::mix(low, high, random.next_1d()));
}

Ray ray_towards(Vec3 origin, Vec3 at) { return {origin, glm::normalize(at - origin)}; }

// Rays from all around at places on the plane of a triangle up to 10 times its size off: t and barycentric coordinates
// are what long doubles say, rounded to float. The t of a needle is as exact as that of any other.
TEST(TriangleTest, CrossingsAreExact) {
  Random random(1);
  using Exact = glm::vec<3, long double>;
  int hits = 0;
  for (int i = 0; i < 200000; ++i) {
    Corners t = random_triangle(random, random_magnitude(random, -3, 2));
    if (i % 3 == 0) t.c = glm::mix(t.a, t.b, random.next_1d()) + 1e-4f * (t.c - t.a);
    const Vec2 at = random.next_2d();
    const Vec3 aim = t.a + at.x * (t.b - t.a) + at.y * (t.c - t.a);
    const Ray ray = ray_towards(3.0f * random_in_cube(random), aim);
    TriangleCrossing crossing;
    if (!cross_triangle(RayFrame<float>(ray), t.a, t.b, t.c, infinity, crossing)) continue;
    const Exact a(t.a), b = Exact(t.b) - a, c = Exact(t.c) - a, d(ray.direction), o = Exact(ray.origin) - a;
    const Exact normal = glm::cross(b, c), moment = glm::cross(o, d);
    const long double determinant = -glm::dot(normal, d);
    if (std::abs(determinant) < 1e-2L * glm::length(normal)) continue;  // grazing: t is ill-conditioned
    ++hits;
    const long double expected_t = glm::dot(o, normal) / determinant;
    EXPECT_NEAR(crossing.t, static_cast<double>(expected_t), 0x1p-22 * static_cast<double>(expected_t));
    const Vec2 expected(glm::dot(c, moment) / determinant, -glm::dot(b, moment) / determinant);
    if (glm::min(expected.x, expected.y) > 0 && expected.x + expected.y < 1) {
      EXPECT_NEAR(crossing.barycentric.x, expected.x, 0x1p-23);
      EXPECT_NEAR(crossing.barycentric.y, expected.y, 0x1p-23);
    }
    // In the frame narrow triangles may be turned over: vertices move there by up to 2^-21 of their distance, below 5.
    const long double height = glm::length(normal) / std::max({glm::length(b), glm::length(c), glm::length(c - b)});
    if (height > 0.01L) {
      EXPECT_EQ(crossing.is_front_face, glm::dot(normal, d) < 0);
    }
  }
  EXPECT_GT(hits, 50000);
}

// Triangles around a vertex, like the sectors of a circle but ragged and not flat. A ray at the vertex, or past it by
// rounding errors, hits one of them at least; so does one at an edge between two.
TEST(TriangleTest, FansHaveNoHoles) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const auto sectors = static_cast<int>(random_index(random, 3, 9));
    const float size = random_magnitude(random, -4, 4);
    const Vec3 middle = random_in_cube(random) * random_magnitude(random, -2, 2);
    std::vector<Vec3> rim;
    for (int k = 0; k < sectors; ++k) {
      const float angle = 2 * pi * (static_cast<float>(k) + 0.3f * random.next_1d()) / static_cast<float>(sectors);
      rim.push_back(middle + size * (0.5f + random.next_1d()) * Vec3(std::cos(angle), std::sin(angle), 0.1f));
    }
    const Vec3 origin = middle + size * Vec3(0.3f * random_in_cube(random).x, 0.3f * random_in_cube(random).y,
                                             1 + 3 * random.next_1d());
    const Vec3 at_edge = glm::mix(middle, rim[random_index(random, 0, rim.size())], 0.4f * random.next_1d());
    for (const Vec3 at : {middle, at_edge}) {
      Ray ray = ray_towards(origin, at);
      if (i % 2) ray.direction += 1e-7f * random_in_cube(random);
      const RayFrame<float> frame(ray);
      bool is_hit = false;
      for (int k = 0; k < sectors; ++k) {
        TriangleCrossing crossing;
        is_hit = is_hit || cross_triangle(frame, middle, rim[k], rim[(k + 1) % sectors], infinity, crossing);
      }
      ASSERT_TRUE(is_hit) << "fan " << i;
    }
  }
}

TEST(TriangleTest, GroupsAnswerLikeSingles) {
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 50000; ++i) {
    const auto count = static_cast<std::uint32_t>(random_index(random, 1, max_group_size + 1));
    std::vector<float> group(9 * count + group_padding, std::nanf(""));
    std::vector<Corners> triangles;
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      Corners t = random_triangle(random, 1);
      if (i % 7 == 0) t.c = t.a;
      set_in_group(group.data(), count, lane, t.a, t.b, t.c);
      triangles.push_back(t);
    }
    // At an edge, a vertex or anywhere.
    const Vec3 at = i % 3 == 0   ? triangles[0].a
                    : i % 3 == 1 ? 0.5f * (triangles[0].a + triangles[0].b)
                                 : random_in_cube(random);
    const Ray ray = i % 5 == 0 ? random_axis_parallel_ray(random, 1) : ray_towards(2.0f * random_in_cube(random), at);
    std::vector<TriangleCrossing> found(count);
    GroupRay(ray).cross(group.data(), count, 3.0f,
                        [&](std::uint32_t lane, const TriangleCrossing& crossing) { found[lane] = crossing; });
    for (std::uint32_t lane = 0; lane < count; ++lane) {
      const Corners& t = triangles[lane];
      TriangleCrossing expected;
      hits += cross_triangle(RayFrame<float>(ray), t.a, t.b, t.c, 3.0f, expected);
      EXPECT_EQ(found[lane].t, expected.t);
      EXPECT_EQ(found[lane].barycentric, expected.barycentric);
      EXPECT_EQ(found[lane].is_front_face, expected.is_front_face);
    }
  }
  EXPECT_GT(hits, 10000);
}

// Whenever the triangle test finds a hit, its box is entered, alone and as one of a pair. Rays aim at edges that are
// edges of the box, too, past them by rounding errors; triangles are tiny, huge, flat and long, rays start beside them
// and within their boxes, and run in the planes of faces.
TEST(BoxTest, LosesNoHitOfTheTriangleTest) {
  Random random(4);
  int hits = 0, beyond_edge = 0;
  for (int i = 0; i < 2000000; ++i) {
    const Vec3 stretch(random_magnitude(random, -3, 3), random_magnitude(random, -3, 3),
                       random_magnitude(random, -3, 3));
    Corners t = random_triangle(random, 1);
    for (Vec3* const p : {&t.a, &t.b, &t.c}) *p *= stretch;
    const auto axis = static_cast<int>(random_index(random, 0, 3));
    const int across = (axis + 1) % 3;
    if (i % 2) t.b = t.a, t.b[axis] *= -random.next_1d();  // an edge that is one of the box
    if (i % 8 == 3) t.c[across] = t.a[across];             // and the triangle in a face of it
    Vec3 at = glm::mix(t.a, t.b, random.next_1d());
    const float size = max_component(glm::abs(t.a - t.b));
    Vec3 origin = at + size * random_magnitude(random, -7, 4) * random_in_cube(random);
    if (i % 16 == 5) origin[across] = t.a[across];
    if (i % 3 == 0) at += size * random_magnitude(random, -9, -6) * random_in_cube(random);
    Ray ray = ray_towards(origin, at);
    if (i % 16 == 5) ray.direction[across] = 0;
    TriangleCrossing crossing;
    if (!cross_triangle(RayFrame<float>(ray), t.a, t.b, t.c, infinity, crossing)) continue;
    ++hits;
    const Bounds box = triangle_bounds(t.a, t.b, t.c);
    NodePair pair;
    pair.set(0, box, NodeLink::leaf(0, 1));
    ASSERT_EQ(PairRay(ray).enter(pair, infinity).mask, 1) << i;
    // Where the ray does not hit by rounding alone, t is that of a point in the box.
    TriangleCrossing exact;
    if (cross_triangle(RayFrame<double>(ray), t.a, t.b, t.c, infinity, exact)) {
      ASSERT_EQ(PairRay(ray).enter(pair, exact.t).mask, 1) << i;
    }
    pair.set(1, box, NodeLink::leaf(0, 1));
    ASSERT_EQ(PairRay(ray).enter(pair, infinity).mask, 3) << i;
    ASSERT_TRUE(is_met_by_line(SlabRay(ray), box)) << i;
    // How often the margin of the box was needed.
    pair.set(0, {glm::min(glm::min(t.a, t.b), t.c), glm::max(glm::max(t.a, t.b), t.c)}, NodeLink::leaf(0, 1));
    beyond_edge += PairRay(ray).enter(pair, infinity).mask != 3;
  }
  EXPECT_GT(hits, 500000);
  EXPECT_GT(beyond_edge, 10) << "no challenge";
}

}  // namespace
}  // namespace candil::test
