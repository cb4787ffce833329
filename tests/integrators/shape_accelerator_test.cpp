// Shapes among triangles behind an accelerator: the nearest accepted crossing, found one by one.
#include <gtest/gtest.h>

#include <cmath>

#include "core/shape.h"
#include "core/warp.h"
#include "tests/support/accelerator_cases.h"
#include "tests/support/chi_square.h"
#include "tests/support/scene_builder.h"
#include "tests/support/shape_samples.h"

namespace candil::test {
namespace {

Mat3 random_linear(Random& random, float size) {
  const Vec3 x = random_in_cube(random), y = random_in_cube(random);
  return size * Mat3(x, y, random_in_cube(random));
}

/// Spheres, discs and planes of single-sided, double-sided and transmissive materials, with or without triangles.
Scene crowd(std::uint32_t seed, bool has_planes, bool has_triangles) {
  Random random(seed);
  SceneBuilder builder;
  const auto one_sided = builder.add_material(Material{}), two_sided = builder.add_diffuse(Vec3(0.5f));
  Material clear;
  clear.transmission = 1;
  const std::uint32_t materials[] = {one_sided, two_sided, builder.add_material(clear)};
  for (int i = 0; i < 150; ++i) {
    const Vec3 center = random_in_cube(random);
    const ShapeKind kind = i % 2 ? ShapeKind::sphere : ShapeKind::disc;
    builder.add_shape(kind, {random_linear(random, 0.2f), center}, materials[i % 3]);
    if (has_planes && i % 50 == 0) {
      const Vec3 through = random_in_cube(random);
      builder.add_shape(ShapeKind::plane, {random_linear(random, 1), 3.0f * through}, materials[i / 50]);
    }
  }
  for (int i = 0; i < 30 && has_triangles; ++i) {
    const Vec3 corner = random_in_cube(random), u = random_in_cube(random);
    builder.add_quad(corner, 0.5f * u, 0.5f * random_in_cube(random), materials[i % 3]);
  }
  return builder.scene;
}

/// The nearest shape, every one asked in turn; backs of one-sided materials do not count.
Hit nearest_shape(const Scene& scene, const Ray& ray) {
  Hit nearest;
  for (std::uint32_t id = 0; id < scene.shapes.size(); ++id) {
    const Material& material = scene.materials[scene.shapes[id].material];
    for (const ShapeCrossing& crossing : ShapeIntersector(scene.shapes[id]).crossings(ray, ray.t_max)) {
      const bool is_there = crossing.is_front_face || material.is_double_sided || material.is_transmissive();
      if (is_there && crossing.t < nearest.t) {
        nearest = {crossing.t, crossing.coordinates, invalid_id, invalid_id, id};
      }
    }
  }
  return nearest;
}

class ShapeAccelerator : public testing::TestWithParam<AcceleratorChoice> {
 protected:
  static std::unique_ptr<Accelerator> make(const Scene& scene) { return make_accelerator_of(GetParam(), scene); }
};

// Triangles are asked through an accelerator that has nothing else.
TEST_P(ShapeAccelerator, FindsTheNearestOfAll) {
  for (const bool has_planes : {false, true}) {
    for (const bool has_triangles : {false, true}) {
      const Scene scene = crowd(1, has_planes, has_triangles);
      Scene triangles = scene;
      triangles.shapes.clear();
      const auto accelerator = make(scene);
      const auto triangle_accelerator = make(triangles);
      Random random(2);
      int hits = 0, on_planes = 0, on_triangles = 0;
      for (int i = 0; i < 20000; ++i) {
        const Ray ray = random_ray(random, 1);
        Hit expected = nearest_shape(scene, ray);
        if (const auto hit = triangle_accelerator->intersect(ray); hit && hit->t < expected.t) expected = *hit;
        const Hit found = accelerator->intersect(ray).value_or(Hit{});
        ASSERT_EQ(found.t, expected.t);
        ASSERT_EQ(accelerator->occluded(ray), !found.is_miss());
        if (found.is_miss()) continue;
        ASSERT_EQ(found.is_shape(), expected.is_shape());
        ASSERT_EQ(found.instance, expected.instance);
        ASSERT_EQ(found.triangle, expected.triangle);
        ASSERT_EQ(found.barycentric, expected.barycentric);
        ASSERT_EQ(material_of(scene, found), make_surface_point(scene, found).material);
        ++hits;
        on_triangles += !found.is_shape();
        on_planes += found.is_shape() && scene.shapes[found.triangle].kind == ShapeKind::plane;
      }
      EXPECT_GT(hits, 5000);
      EXPECT_EQ(on_planes > 500, has_planes);
      EXPECT_EQ(on_triangles > 500, has_triangles);
    }
  }
}

// intersect_each() gives each ray the answer that it gets alone, misses included.
TEST_P(ShapeAccelerator, ManyRaysAreLikeEachAlone) {
  const Scene scene = crowd(3, true, true);
  const auto accelerator = make(scene);
  Random random(4);
  std::vector<Ray> rays;
  for (int i = 0; i < 1000; ++i) rays.push_back(random_ray(random, 1));
  std::vector<Hit> hits(rays.size(), Hit{0.5f, Vec2(7), 1, 2, 3});
  accelerator->intersect_each(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit alone = accelerator->intersect(rays[i]).value_or(Hit{});
    ASSERT_EQ(hits[i].t, alone.t);
    if (alone.is_miss()) continue;
    ASSERT_EQ(hits[i].triangle, alone.triangle);
    ASSERT_EQ(hits[i].mesh, alone.mesh);
  }
}

class ShapeInHierarchy : public testing::TestWithParam<std::tuple<AcceleratorChoice, ShapeSample>> {};

// Single-precision boxes around it lose no ray that double precision hits: rays from inside of a sphere all end on it,
// and rays from afar at any point of a shape's front hit something.
TEST_P(ShapeInHierarchy, LosesNoRay) {
  const Shape& shape = std::get<1>(GetParam()).shape;
  const Scene scene = scene_of(shape);
  Scene opaque = scene;
  opaque.materials[0].base_color_texture.texture = invalid_id;
  const auto accelerator = make_accelerator_of(std::get<0>(GetParam()), opaque);
  const ShapeIntersector intersector(shape);
  Random random(5);
  int lost = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 inside =
        shape.to_world.point(0.99f * glm::normalize(sample_sphere(random.next_2d())) * random.next_1d());
    const Vec3 direction = glm::normalize(sample_sphere(random.next_2d()));
    const float distance = std::pow(10.0f, 6 * random.next_1d()) * glm::length(shape.to_world.linear[0]);
    for (const Ray& ray : {Ray{inside, direction}, Ray{inside - distance * direction, direction}}) {
      const ShapeCrossings crossings = intersector.crossings(ray, infinity);
      const std::optional<Hit> hit = accelerator->intersect(ray);
      lost += hit.has_value() != (crossings.count > 0) || accelerator->occluded(ray) != hit.has_value();
      if (hit) {
        ASSERT_EQ(hit->t, crossings.list[0].t);
      }
      if (shape.kind == ShapeKind::sphere && ray.origin == inside) lost += crossings.count != 1;
    }
  }
  EXPECT_EQ(lost, 0);
}

INSTANTIATE_TEST_SUITE_P(All, ShapeInHierarchy,
                         testing::Combine(testing::ValuesIn(accelerator_choices()), testing::ValuesIn(shape_samples())),
                         [](const auto& test) {
                           return std::get<0>(test.param).name() + "_" + std::get<1>(test.param).name;
                         });

// A fine mesh of the same ball is inside of it by its sagitta at most: hits agree but for that and its slant.
TEST_P(ShapeAccelerator, AgreesWithAFineMeshOfABall) {
  constexpr int rows = 256;
  const Affine to_world{Mat3(Vec3(1.5f, 0.2f, 0), Vec3(-0.4f, 1, 0.3f), Vec3(0, 0.6f, -1)), Vec3(-1, 0, 4)};
  SceneBuilder exact, fine;
  exact.add_shape(ShapeKind::sphere, to_world, exact.add_diffuse(Vec3(0.5f)));
  fine.add_sphere(Vec3(0), 1, fine.add_diffuse(Vec3(0.5f)), rows);
  fine.scene.instances[0].to_world = to_world;
  fine.scene.instances[0].is_world_space = false;
  const auto exact_accelerator = make(exact.scene);
  const auto fine_accelerator = make(fine.scene);
  // 1 - cos of half a cell's diagonal, in units of the ball; the transform stretches by less than 2.
  const float sagitta = 2 * (1 - std::cos(std::sqrt(2.0f) * pi / (2 * rows)));
  Random random(6);
  const int rays = GetParam().kind == AcceleratorKind::brute ? 200 : 50000;  // 261,120 triangles
  int compared = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 origin = to_world.translation + 5.0f * random_in_cube(random);
    const Vec3 aim = to_world.translation + random_in_cube(random);
    if (origin == aim) continue;
    const Ray ray{origin, glm::normalize(aim - origin)};
    const std::optional<Hit> a = exact_accelerator->intersect(ray), b = fine_accelerator->intersect(ray);
    if (!a) {
      ASSERT_FALSE(b) << "the mesh is inside";
      continue;
    }
    const SurfacePoint on = make_surface_point(exact.scene, *a);
    const float cosine = std::abs(glm::dot(on.normal_geometric, ray.direction));
    if (cosine < 0.2f) continue;
    ASSERT_TRUE(b);
    ++compared;
    const SurfacePoint on_mesh = make_surface_point(fine.scene, *b);
    ASSERT_NEAR(a->t, b->t, 1.5f * sagitta / cosine + 1e-5f);
    ASSERT_GT(glm::dot(on.normal, on_mesh.normal), 0.9999f) << "front sides agree, mirrored as it is";
  }
  EXPECT_GT(compared, rays / 5);
}

TEST_P(ShapeAccelerator, AgreesWithAFineMeshOfADisc) {
  constexpr std::uint32_t corners = 1024;
  const Affine to_world{Mat3(Vec3(1.5f, 0.2f, 0), Vec3(-0.4f, 1, 0.3f), Vec3(0, 0.6f, -1)), Vec3(-1, 0, 4)};
  SceneBuilder exact, fine;
  exact.add_shape(ShapeKind::disc, to_world, exact.add_material(Material{}));
  Mesh fan;
  fan.positions = {Vec3(0)};
  for (std::uint32_t i = 0; i < corners; ++i) {
    const float angle = 2 * pi * static_cast<float>(i) / corners;
    fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    fan.triangles.push_back({0, i + 1, (i + 1) % corners + 1});
  }
  fine.add_mesh(fan, fine.add_material(Material{}));
  fine.scene.instances[0].to_world = to_world;
  fine.scene.instances[0].is_world_space = false;
  const auto exact_accelerator = make(exact.scene);
  const auto fine_accelerator = make(fine.scene);
  Random random(7);
  int compared = 0, differ = 0, culled = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 origin = to_world.translation + 5.0f * random_in_cube(random);
    const Vec3 aim = to_world.translation + 2.0f * random_in_cube(random);
    const Ray ray{origin, glm::normalize(aim - origin)};
    const std::optional<Hit> a = exact_accelerator->intersect(ray), b = fine_accelerator->intersect(ray);
    differ += a.has_value() != b.has_value();
    culled += !a && ShapeIntersector(exact.scene.shapes[0]).crossings(ray, infinity).count > 0;
    if (!a || !b) continue;
    ++compared;
    ASSERT_NEAR(a->t, b->t, 1e-3f);
    ASSERT_GT(glm::dot(make_surface_point(exact.scene, *a).normal, make_surface_point(fine.scene, *b).normal), 0.9999f);
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(culled, 2000) << "backs";
  EXPECT_LE(differ, 3) << "of 50000 rays, at the rim";
}

// BLEND lets a share of all rays through each side, independently: of a sphere with alpha 1/2 a quarter sees through.
TEST_P(ShapeAccelerator, AlphaCountsOnBothSidesOfASphere) {
  SceneBuilder builder;
  Material half = Material{};
  half.base_color.w = 0.5f;
  half.alpha_mode = AlphaMode::blend;
  half.is_double_sided = true;
  builder.add_shape(ShapeKind::sphere, {Mat3(2), Vec3(0)}, builder.add_material(half));
  const auto accelerator = make(builder.scene);
  Random random(8);
  std::vector<double> observed(3);
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i) {
    const Ray ray{Vec3(0, 0, 5), glm::normalize(Vec3(0.2f * (random.next_2d() - 0.5f), -1))};
    const std::optional<Hit> hit = accelerator->intersect(ray);
    ASSERT_EQ(accelerator->occluded(ray), hit.has_value());
    ++observed[!hit ? 0 : hit->t < 5 ? 1 : 2];
  }
  const std::vector<double> expected = {0.25 * count, 0.5 * count, 0.25 * count};
  EXPECT_GT(chi_square_test(observed, expected).p_value, significance);
}

INSTANTIATE_TEST_SUITE_P(All, ShapeAccelerator, testing::ValuesIn(accelerator_choices()), choice_name);

}  // namespace
}  // namespace candil::test
