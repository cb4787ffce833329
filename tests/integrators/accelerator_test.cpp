// Embree against every triangle, one after the other, in double precision.
#include "core/accelerator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/warp.h"
#include "materials/alpha.h"
#include "tests/support/brute_force.h"
#include "tests/support/chi_square.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

Vec3 random_in_cube(Random& random) {
  const Vec2 xy = random.next_2d();
  return 2.0f * Vec3(xy, random.next_1d()) - 1.0f;
}

Vec3 random_direction(Random& random) { return glm::normalize(sample_sphere(random.next_2d())); }

/// Triangles of random sizes and places in a cube of half side `scale`.
Mesh random_soup(Random& random, int triangle_count, float scale) {
  Mesh mesh;
  for (int i = 0; i < triangle_count; ++i) {
    const Vec3 center = random_in_cube(random);
    const float size = 0.02f + 0.4f * random.next_1d();
    for (int corner = 0; corner < 3; ++corner)
      mesh.positions.push_back(scale * (center + size * random_in_cube(random)));
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

std::uint32_t add_single_sided(SceneBuilder& builder) { return builder.add_material(Material{}); }

std::uint32_t add_transmissive(SceneBuilder& builder) {
  Material material;
  material.transmission = 1;
  return builder.add_material(material);
}

/// Single-sided, double-sided and transmissive triangles in equal parts.
Scene mixed_soup(float scale, std::uint32_t seed) {
  Random random(seed);
  SceneBuilder builder;
  for (const std::uint32_t material :
       {add_single_sided(builder), builder.add_diffuse(Vec3(0.5f)), add_transmissive(builder)}) {
    builder.add_mesh(random_soup(random, 100, scale), material);
  }
  return builder.scene;
}

/// Origins in and around the cube; every second ray ends somewhere in it.
Ray random_ray(Random& random, float scale) {
  Ray ray{1.5f * scale * random_in_cube(random), random_direction(random)};
  if (random.next_1d() < 0.5f) ray.t_max = 2 * scale * random.next_1d();
  return ray;
}

Ray random_axis_parallel_ray(Random& random, float scale) {
  Ray ray{1.5f * scale * random_in_cube(random), Vec3(0)};
  ray.direction[static_cast<int>(3 * random.next_1d())] = random.next_1d() < 0.5f ? -1.0f : 1.0f;
  return ray;
}

/// Judges `ray_count` rays against both filters; at least `decided_share` of them must have had one right answer only.
template <class MakeRay>
void expect_agreement(const Scene& scene, int ray_count, double decided_share, const MakeRay& make_ray) {
  for (const bool is_filtered : {false, true}) {
    SCOPED_TRACE(is_filtered ? "alpha filter" : "no filter");
    const auto accelerator = make_accelerator(scene, is_filtered ? alpha_filter() : HitFilter{});
    const BruteForce judge(scene,
                           is_filtered ? BruteForce::BackFaces::as_materials_say : BruteForce::BackFaces::visible);
    Random random(42);
    int complaints = 0, decided = 0, hits = 0;
    for (int i = 0; i < ray_count && complaints < 5; ++i) {
      const Ray ray = make_ray(random);
      const std::optional<Hit> hit = accelerator->intersect(ray);
      const BruteForce::Verdict verdict = judge.judge(ray, hit);
      EXPECT_EQ(verdict.complaint, "");
      complaints += !verdict.complaint.empty();
      hits += hit.has_value();
      decided += verdict.is_decided;
      // Where rounding decides, the two kinds of queries may round differently.
      if (verdict.is_decided) {
        EXPECT_EQ(accelerator->occluded(ray), hit.has_value()) << "ray " << i;
      }
    }
    EXPECT_GE(decided, decided_share * ray_count) << "bounds too wide to tell";
    EXPECT_GT(hits, ray_count / 20) << "too few hits to tell";
    EXPECT_GT(ray_count - hits, ray_count / 20) << "too few misses to tell";
  }
}

class RandomSoup : public testing::TestWithParam<float> {};

TEST_P(RandomSoup, AgreesWithBruteForce) {
  const float scale = GetParam();
  expect_agreement(mixed_soup(scale, 1), 10000, 0.99, [&](Random& random) { return random_ray(random, scale); });
}

TEST_P(RandomSoup, AgreesAlongTheAxes) {
  const float scale = GetParam();
  expect_agreement(mixed_soup(scale, 2), 10000, 0.99,
                   [&](Random& random) { return random_axis_parallel_ray(random, scale); });
}

INSTANTIATE_TEST_SUITE_P(Scales, RandomSoup, testing::Values(1.0f, 1e6f, 1e-6f), [](const auto& test) {
  return test.param == 1 ? "ordinary" : test.param > 1 ? "huge" : "tiny";
});

// A small soup far from the world's origin: what counts is the distance to the ray's origin, not the coordinates.
TEST(Accelerator, AgreesFarFromTheOrigin) {
  Scene scene = mixed_soup(1, 3);
  const Vec3 far(1e5f, -2e5f, 3e5f);
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& p : mesh.positions) p += far;
  }
  expect_agreement(scene, 5000, 0.99, [&](Random& random) {
    Ray ray = random_ray(random, 1);
    ray.origin += far;
    return ray;
  });
}

/// A ray from anywhere at a random point of a triangle's first edge.
Ray ray_at_edge(Random& random, const Mesh& mesh, std::size_t triangle) {
  const Triangle t = mesh.triangles[triangle];
  const Vec3 origin = 1.5f * random_in_cube(random);
  const Vec3 at = glm::mix(mesh.positions[t.x], mesh.positions[t.y], random.next_1d());
  return {origin, glm::normalize(at - origin)};
}

std::size_t random_index(Random& random, std::size_t first, std::size_t end) {
  return first + static_cast<std::size_t>(random.next_1d() * static_cast<float>(end - first));
}

// Triangles with two corners in one place among others: nothing hits them, even aimed at, and they hide nothing.
TEST(Accelerator, TrianglesOfRepeatedCornersAreNeverHit) {
  Random random(4);
  SceneBuilder builder;
  const std::uint32_t material = builder.add_diffuse(Vec3(0.5f));
  Mesh mesh = random_soup(random, 200, 1);
  const std::size_t sound_triangles = mesh.triangles.size();
  for (int i = 0; i < 200; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Vec3 a = random_in_cube(random), b = random_in_cube(random);
    mesh.positions.insert(mesh.positions.end(), {a, b, a});
    mesh.triangles.push_back({first, first, first});          // a point
    mesh.triangles.push_back({first, first + 1, first + 1});  // a line, one vertex used twice
    mesh.triangles.push_back({first, first + 1, first + 2});  // a line, two vertices in one place
  }
  builder.add_mesh(mesh, material);
  expect_agreement(builder.scene, 10000, 0.98, [&](Random& numbers) {
    if (numbers.next_1d() < 0.5f) return random_ray(numbers, 1);
    return ray_at_edge(numbers, mesh, random_index(numbers, sound_triangles, mesh.triangles.size()));
  });
}

// Three corners in three places of one line: subtracting the ray's origin may bend the line by a rounding error, and
// then a ray that aims at it does hit. Nowhere else may there be a hit: within 16 rounding errors (2^-24 of the
// distances, all below 8) of the line.
TEST(Accelerator, TrianglesOfCornersInALineAreHitOnTheLineOnly) {
  Random random(5);
  Mesh mesh;
  for (int i = 0; i < 200; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    // Multiples of 1/64: their midpoint is exact.
    const Vec3 a = glm::round(random_in_cube(random) * 64.0f) / 64.0f,
               b = glm::round(random_in_cube(random) * 64.0f) / 64.0f;
    mesh.positions.insert(mesh.positions.end(), {a, b, 0.5f * (a + b)});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  SceneBuilder builder;
  builder.add_mesh(mesh, builder.add_diffuse(Vec3(0.5f)));
  const auto accelerator = make_accelerator(builder.scene, alpha_filter());
  double farthest = 0;
  for (int i = 0; i < 50000; ++i) {
    const Ray ray =
        i % 2 ? random_ray(random, 1) : ray_at_edge(random, mesh, random_index(random, 0, mesh.triangles.size()));
    const std::optional<Hit> hit = accelerator->intersect(ray);
    if (!hit) continue;
    const Triangle t = mesh.triangles[hit->triangle];
    const glm::dvec3 a(mesh.positions[t.x]), along = glm::dvec3(mesh.positions[t.y]) - a, direction(ray.direction);
    // Distance between the ray's line and the triangle's.
    const double distance =
        std::abs(glm::dot(glm::dvec3(ray.origin) - a, glm::normalize(glm::cross(along, direction))));
    farthest = std::max(farthest, distance);
  }
  EXPECT_LT(farthest, 16 * 8 * 0x1p-24);
}

/// A ball whose triangles share their vertices all around: no seam.
Mesh closed_ball(int rows) {
  Mesh mesh;
  const int columns = 2 * rows;
  mesh.positions = {Vec3(0, 1, 0), Vec3(0, -1, 0)};
  for (int i = 1; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const float theta = pi * static_cast<float>(i) / static_cast<float>(rows);
      const float phi = pi * static_cast<float>(j) / static_cast<float>(rows);
      mesh.positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
    }
  }
  const auto vertex = [&](int i, int j) -> std::uint32_t {
    if (i == 0 || i == rows) return i == 0 ? 0 : 1;
    return static_cast<std::uint32_t>(2 + (i - 1) * columns + j % columns);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (i > 0) mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)});
      if (i + 1 < rows) mesh.triangles.push_back({vertex(i, j + 1), vertex(i + 1, j), vertex(i + 1, j + 1)});
    }
  }
  return mesh;
}

// From inside of a closed surface every ray hits, those too that aim at a point of an edge; in world space and through
// an instance that mirrors and stretches. Embree promises nothing for vertices: of the rays that aim at one, a few in a
// thousand slip through.
TEST(Accelerator, ClosedSurfacesHaveNoHoles) {
  SceneBuilder builder;
  const Mesh ball = closed_ball(40);
  builder.add_mesh(ball, builder.add_diffuse(Vec3(0.5f)));
  for (const bool is_instanced : {false, true}) {
    Affine to_world;
    if (is_instanced) to_world = {Mat3(Vec3(-3, 0.5f, 0), Vec3(0.2f, 1, 0.1f), Vec3(0, 0, 2)), Vec3(10, -20, 30)};
    builder.scene.instances[0].to_world = to_world;
    builder.scene.instances[0].is_world_space = !is_instanced;
    const auto accelerator = make_accelerator(builder.scene, alpha_filter());
    Random random(6);
    int misses = 0, misses_at_vertices = 0;
    const auto misses_ray = [&](Vec3 origin, Vec3 towards) {
      const Ray ray{origin, glm::normalize(towards)};
      return !accelerator->intersect(ray) || !accelerator->occluded(ray);
    };
    for (int i = 0; i < 200000; ++i) {
      const Vec3 origin = to_world.point(0.5f * random_in_cube(random));  // the ball's inscribed radius is above 0.99
      const Triangle t = ball.triangles[random_index(random, 0, ball.triangles.size())];
      const Vec3 a = to_world.point(ball.positions[t.x]), b = to_world.point(ball.positions[t.y]);
      const float along = glm::mix(0.001f, 0.999f, random.next_1d());
      misses += misses_ray(origin, i % 2 == 0 ? random_direction(random) : glm::mix(a, b, along) - origin);
      misses_at_vertices += misses_ray(origin, a - origin);
    }
    EXPECT_EQ(misses, 0) << (is_instanced ? "instanced" : "in world space");
    EXPECT_LT(misses_at_vertices, 2000) << (is_instanced ? "instanced" : "in world space");
  }
}

// One object of two meshes, used mirrored, stretched, turned and moved, beside a soup in world space.
TEST(Accelerator, AgreesThroughInstances) {
  Random random(7);
  SceneBuilder builder;
  builder.add_mesh(random_soup(random, 80, 1), add_single_sided(builder));
  const auto first = builder.add_mesh(random_soup(random, 40, 0.5f), add_single_sided(builder));
  builder.add_mesh(random_soup(random, 40, 0.5f), builder.add_diffuse(Vec3(0.5f)));
  Scene& scene = builder.scene;
  scene.objects.resize(1);
  scene.objects.push_back({"pair", first, 2});
  scene.instances.resize(1);
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const Mat3 turned(Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c));
  for (const Affine& to_world :
       {Affine{Mat3(1), Vec3(0.7f, 0, 0)}, Affine{Mat3(-1), Vec3(-0.7f, 0.2f, 0)},
        Affine{Mat3(Vec3(1, 0, 0), Vec3(0, -0.5f, 0), Vec3(0, 0, 1.5f)), Vec3(0, 0.7f, 0.3f)},
        Affine{turned * 0.6f, Vec3(0, -0.7f, 0.7f)},
        Affine{turned * Mat3(Vec3(0.7f, 0, 0), Vec3(0.4f, 1, 0), Vec3(0, 0.3f, 1)), Vec3(0)}}) {
    scene.instances.push_back({"", 1, to_world, false});
  }
  expect_agreement(scene, 10000, 0.98, [](Random& numbers) { return random_ray(numbers, 1); });
}

// A hit just before t_max counts, one just behind it does not; the next one behind never takes its place.
TEST(Accelerator, RespectsTheEndOfTheRay) {
  const Scene scene = mixed_soup(1, 8);
  const auto accelerator = make_accelerator(scene, alpha_filter());
  Random random(9);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    Ray ray = random_ray(random, 1);
    const std::optional<Hit> hit = accelerator->intersect(ray);
    if (!hit || hit->t < 1e-3f) continue;
    ++hits;
    ray.t_max = hit->t * 0.9999f;
    EXPECT_FALSE(accelerator->intersect(ray));
    EXPECT_FALSE(accelerator->occluded(ray));
    ray.t_max = hit->t * 1.0001f;
    const std::optional<Hit> again = accelerator->intersect(ray);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->triangle, hit->triangle);
    EXPECT_EQ(again->t, hit->t);
    EXPECT_TRUE(accelerator->occluded(ray));
  }
  EXPECT_GT(hits, 1000);
}

TEST(Accelerator, EmptySceneIsNeverHit) {
  const Scene scene;
  const auto accelerator = make_accelerator(scene, alpha_filter());
  EXPECT_FALSE(accelerator->intersect(Ray{}));
  EXPECT_FALSE(accelerator->occluded(Ray{}));
}

}  // namespace
}  // namespace candil::test
