// Every kind of accelerator against every triangle, one after the other, in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/warp.h"
#include "tests/support/accelerator_cases.h"
#include "tests/support/scene_builder.h"

namespace candil::test {
namespace {

class AcceleratorOfKind : public testing::TestWithParam<AcceleratorChoice> {};

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

INSTANTIATE_TEST_SUITE_P(Scales, RandomSoup, testing::Values(1.0f, 1e9f, 1e-6f), [](const auto& test) {
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

// Needles 1 long and 1e-2 to 1e-5 wide, in all directions: their boxes say little.
TEST(Accelerator, AgreesOnSlivers) {
  Random random(10);
  Mesh mesh;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Vec3 a = random_in_cube(random), along = random_direction(random);
    const float width = std::pow(10.0f, -2 - 3 * random.next_1d());
    mesh.positions.insert(mesh.positions.end(), {a, a + along, a + 0.5f * along + width * random_direction(random)});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  SceneBuilder builder;
  builder.add_mesh(mesh, builder.add_material(Material{}));
  expect_agreement(
      builder.scene, 20000, 0.3,
      [&](Random& numbers) {
        // At a needle or past it by as much as its width.
        const Triangle t = mesh.triangles[random_index(numbers, 0, 300)];
        const Vec3 axis = glm::mix(mesh.positions[t.x], mesh.positions[t.y], numbers.next_1d());
        const Vec3 at = glm::mix(axis, mesh.positions[t.z], 3 * numbers.next_1d() - 1),
                   from = 1.5f * random_in_cube(numbers);
        return Ray{from, glm::normalize(at - from)};
      },
      0.02);
}

/// Triangles whose corners are on a grid of 1/4, half of them within a plane of it: many boxes are flat, and share
/// planes.
Mesh grid_soup(Random& random, int triangle_count) {
  Mesh mesh;
  const auto on_grid = [](Vec3 p) { return glm::round(4.0f * p) / 4.0f; };
  for (int i = 0; i < triangle_count; ++i) {
    const Vec3 center = random_in_cube(random);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back(on_grid(center + 0.5f * random_in_cube(random)));
      if (i % 2) mesh.positions.back()[i / 2 % 3] = on_grid(center)[i / 2 % 3];
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

// Origins on the planes of the grid, directions along axes and within those planes: the rays run in the faces of
// boxes, in triangles and through corners. Where they do, rounding may decide, but not elsewhere on their way.
TEST(Accelerator, AgreesInThePlanesOfBoxes) {
  Random random(11);
  SceneBuilder builder;
  builder.add_mesh(grid_soup(random, 150), builder.add_material(Material{}));
  builder.add_mesh(grid_soup(random, 150), builder.add_diffuse(Vec3(0.5f)));
  expect_agreement(builder.scene, 30000, 0.15, [](Random& numbers) {
    Ray ray{1.5f * random_in_cube(numbers), random_direction(numbers)};
    const auto axis = static_cast<int>(random_index(numbers, 0, 3));
    ray.origin[axis] = glm::round(4 * ray.origin[axis]) / 4;
    if (numbers.next_1d() < 0.5f) {
      // Within the plane; the sign of the zero must not matter.
      ray.direction[axis] = numbers.next_1d() < 0.5f ? 0.0f : -0.0f;
      ray.direction = glm::normalize(ray.direction);
    } else {
      ray.direction = Vec3(0);
      ray.direction[(axis + 1) % 3] = numbers.next_1d() < 0.5f ? 1.0f : -1.0f;
    }
    return ray;
  });
}

// Origins on triangles, as exactly as float can say: whether it is hit at 0 is open, but nothing nearer or farther than
// the next triangle is right.
TEST(Accelerator, AgreesForRaysThatStartOnSurfaces) {
  const Scene scene = mixed_soup(1, 12);
  expect_agreement(scene, 20000, 0, [&](Random& random) {
    const Mesh& mesh = scene.meshes[random_index(random, 0, scene.meshes.size())];
    const Triangle t = mesh.triangles[random_index(random, 0, mesh.triangles.size())];
    const Vec2 b = sample_triangle(random.next_2d());
    const Vec3 origin = (1 - b.x - b.y) * mesh.positions[t.x] + b.x * mesh.positions[t.y] + b.y * mesh.positions[t.z];
    return Ray{origin, random_direction(random)};
  });
}

// The same triangles several times over in several meshes: any of them is right, and they hide what is behind.
TEST(Accelerator, AgreesOnDuplicates) {
  Random random(13);
  SceneBuilder builder;
  Mesh mesh = random_soup(random, 50, 1);
  const std::vector<Triangle> once = mesh.triangles;
  for (int i = 0; i < 7; ++i) mesh.triangles.insert(mesh.triangles.end(), once.begin(), once.end());
  builder.add_mesh(mesh, builder.add_diffuse(Vec3(0.5f)));
  builder.add_mesh(mesh, builder.add_material(Material{}));
  expect_agreement(
      builder.scene, 5000, 0.1, [](Random& numbers) { return random_ray(numbers, 1); }, 0.02);
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
TEST_P(AcceleratorOfKind, TrianglesOfCornersInALineAreHitOnTheLineOnly) {
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
  const auto accelerator = make_accelerator_of(GetParam(), builder.scene);
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

// One object of two meshes, used mirrored, stretched, turned and moved, beside a soup in world space.
TEST(Accelerator, AgreesThroughInstances) {
  Random random(7);
  SceneBuilder builder;
  const std::uint32_t single_sided = builder.add_material(Material{});
  builder.add_mesh(random_soup(random, 80, 1), single_sided);
  const auto first = builder.add_mesh(random_soup(random, 40, 0.5f), single_sided);
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
TEST_P(AcceleratorOfKind, RespectsTheEndOfTheRay) {
  const Scene scene = mixed_soup(1, 8);
  const auto accelerator = make_accelerator_of(GetParam(), scene);
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

TEST_P(AcceleratorOfKind, EmptySceneIsNeverHit) {
  const Scene scene;
  const auto accelerator = make_accelerator_of(GetParam(), scene);
  EXPECT_FALSE(accelerator->intersect(Ray{}));
  EXPECT_FALSE(accelerator->occluded(Ray{}));
}

INSTANTIATE_TEST_SUITE_P(All, AcceleratorOfKind, testing::ValuesIn(accelerator_choices()), choice_name);

}  // namespace
}  // namespace candil::test
