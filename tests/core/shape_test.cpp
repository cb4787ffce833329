// Where rays meet shapes, against world-space mathematics in long double; and what is there.
#include "core/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/warp.h"
#include "tests/support/chi_square.h"
#include "tests/support/shape_samples.h"

namespace candil::test {
namespace {

using Real = long double;
using RealVec3 = glm::vec<3, Real>;
using RealMat3 = glm::mat<3, 3, Real>;

class Shapes : public testing::TestWithParam<ShapeSample> {
 protected:
  Shapes() : shape_(GetParam().shape), linear_(shape_.to_world.linear), center_(shape_.to_world.translation) {
    for (int axis = 0; axis < 3; ++axis) size_ = std::max(size_, static_cast<float>(glm::length(linear_[axis])));
  }

  RealVec3 world(RealVec3 local) const { return linear_ * local + center_; }
  bool is_sphere() const { return shape_.kind == ShapeKind::sphere; }

  Vec2 random_coordinates(Random& random) const {
    if (is_sphere()) return unit_to_octahedral(sample_sphere(random.next_2d()));
    if (shape_.kind == ShapeKind::disc) return sample_disc(random.next_2d());
    return 20.0f * random.next_2d() - 10.0f;
  }

  /// Origins in and around the shape, most of them aimed at it.
  Ray random_ray(Random& random) const {
    const Vec3 direction = sample_sphere(random.next_2d());
    const Vec2 xy = random.next_2d();
    const Vec3 origin =
        shape_.to_world.translation + size_ * (4.0f * Vec3(xy, random.next_1d()) - 2.0f) * 3.0f * random.next_1d();
    if (random.next_1d() < 0.3f) return {origin, glm::normalize(direction)};
    const Vec2 disc = sample_disc(random.next_2d());
    const Vec3 aim = shape_.to_world.point(0.9f * Vec3(disc, is_sphere() ? 0.5f * random.next_1d() : 0.0f));
    return {origin, glm::normalize(aim - origin)};
  }

  /// Expected crossings of the whole line, and whether rounding may change their number.
  struct Expected {
    std::vector<Real> t;
    bool is_doubtful = false;
  };
  Expected expected_crossings(const Ray& ray) const {
    const RealVec3 from = RealVec3(ray.origin) - center_, direction(ray.direction);
    if (!is_sphere()) {
      // The plane through the centre along the first two axes.
      const RealVec3 normal = glm::cross(linear_[0], linear_[1]);
      const Real towards = glm::dot(direction, normal);
      if (std::abs(towards) < 1e-6L * glm::length(normal)) return {{}, true};
      const Real t = -glm::dot(from, normal) / towards;
      if (shape_.kind == ShapeKind::plane) return {{t}};
      // x a + y b = p, by the normal equations.
      const RealVec3 p = from + t * direction, a = linear_[0], b = linear_[1];
      const Real aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), pa = glm::dot(p, a),
                 pb = glm::dot(p, b);
      const Real x = (pa * bb - pb * ab) / (aa * bb - ab * ab), y = (pb * aa - pa * ab) / (aa * bb - ab * ab);
      const Real radius = std::hypot(x, y);
      if (radius > 1) return {{}, radius < 1 + 1e-9L};
      return {{t}, radius > 1 - 1e-9L};
    }
    // p^T Q p = 1 with Q = (M M^T)^-1: a quadratic equation in t, solved without cancellation.
    const RealMat3 q = glm::inverse(linear_ * glm::transpose(linear_));
    const Real a = glm::dot(direction, q * direction), b = glm::dot(from, q * direction),
               c = glm::dot(from, q * from) - 1;
    const Real discriminant = b * b - a * c;
    const bool is_doubtful = std::abs(discriminant) < 1e-9L * (b * b + std::abs(a * c));
    if (discriminant < 0) return {{}, is_doubtful};
    const Real sum = -(b + std::copysign(std::sqrt(discriminant), b));
    const Real t1 = sum / a, t2 = c / sum;
    return {{std::min(t1, t2), std::max(t1, t2)}, is_doubtful};
  }

  Shape shape_;
  RealMat3 linear_;
  RealVec3 center_;
  float size_ = 0;
};

TEST_P(Shapes, AreHitWhereMathematicsSays) {
  const ShapeIntersector intersector(shape_);
  Random random(1);
  int hits = 0, doubtful = 0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Ray ray = random_ray(random);
    const Expected expected = expected_crossings(ray);
    if (expected.is_doubtful && ++doubtful) continue;
    const ShapeCrossings found = intersector.crossings(ray, infinity);
    std::vector<Real> ahead;
    for (const Real t : expected.t) {
      if (t >= 0) ahead.push_back(t);
    }
    ASSERT_EQ(found.count, ahead.size()) << "ray " << i;
    hits += found.count;
    for (int k = 0; k < found.count; ++k) {
      const ShapeCrossing& crossing = found.list[k];
      // Half a unit in the last place of a float, and the rounding in double precision, of a place that may be 1e3
      // sizes away and is seen at a grazing angle.
      ASSERT_NEAR(crossing.t, static_cast<double>(ahead[k]), static_cast<double>(ahead[k]) * 0x1.01p-24 + 1e-9 * size_);
      // The coordinates name the same place, and the sides alternate: out of a sphere is its back.
      const RealVec3 local = is_sphere() ? RealVec3(octahedral_to_unit(crossing.coordinates))
                                         : RealVec3(RealVec3(crossing.coordinates.x, crossing.coordinates.y, 0));
      const RealVec3 there = RealVec3(ray.origin) + ahead[k] * RealVec3(ray.direction);
      ASSERT_LT(glm::length(world(local) - there), 3e-7L * size_ * std::max<Real>(1, glm::length(local)));
      const bool is_front = is_sphere()
                                ? k + 1 < static_cast<int>(expected.t.size()) && ahead.size() == 2
                                : glm::dot(RealVec3(ray.direction), glm::transpose(glm::inverse(linear_))[2]) < 0;
      ASSERT_EQ(crossing.is_front_face, is_front);
    }
  }
  EXPECT_GT(hits, count / 4);
  EXPECT_LT(doubtful, count / 100);
}

TEST_P(Shapes, CrossingsRespectTheEndOfTheRay) {
  const ShapeIntersector intersector(shape_);
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_ray(random);
    const ShapeCrossings all = intersector.crossings(ray, infinity);
    for (int k = 0; k < all.count; ++k) {
      const float t = all.list[k].t;
      ASSERT_GE(t, 0);
      if (t == 0) continue;  // it starts on the shape
      EXPECT_EQ(intersector.crossings(ray, std::nextafter(t, infinity)).count, k + 1);
      EXPECT_EQ(intersector.crossings(ray, std::nextafter(t, 0.0f)).count, k);
    }
  }
}

// A ray that leaves a point of a shape does not hit it again: a disc or a plane never, a sphere only from inside, and
// then just once, on its other side. Directions along the surface within the rounding of the normal do not count.
TEST_P(Shapes, RaysThatLeaveDoNotComeBackAndNoneLeaksThrough) {
  const ShapeIntersector intersector(shape_);
  const Scene scene = scene_of(shape_);
  Random random(3);
  int wrong = 0;
  for (int i = 0; i < 150000; ++i) {
    const SurfacePoint point = shape_surface_point(scene, 0, random_coordinates(random));
    ASSERT_GT(point.offset, 0);
    const Vec3 direction = glm::normalize(sample_sphere(random.next_2d()));
    const float cosine = glm::dot(direction, point.normal_geometric);
    if (std::abs(cosine) < 1e-5f) continue;
    const ShapeCrossings found = intersector.crossings({offset_origin(point, direction), direction}, infinity);
    const bool enters = is_sphere() && cosine < 0;
    wrong += enters ? found.count != 1 || found.list[0].is_front_face : found.count != 0;
  }
  EXPECT_EQ(wrong, 0);
}

// Normals are M^-T n, tangents the derivative by u: both from finite differences of the surface itself.
TEST_P(Shapes, SurfacePointsHaveTheFrameOfTheSurface) {
  const Scene scene = scene_of(shape_);
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 coordinates = random_coordinates(random);
    const SurfacePoint point = shape_surface_point(scene, 0, coordinates);
    const RealVec3 local =
        is_sphere() ? RealVec3(octahedral_to_unit(coordinates)) : RealVec3(coordinates.x, coordinates.y, 0);
    EXPECT_TRUE(point.is_on_shape());
    EXPECT_EQ(point.triangle, 0u);
    EXPECT_LT(glm::length(RealVec3(point.position) - world(local)), 1e-7L * glm::length(world(local)));
    // Steps along east and north (sphere), or along x and y.
    RealVec3 east(1, 0, 0), north(0, 1, 0);
    if (is_sphere()) {
      if (std::hypot(local.x, local.z) < 1e-3L) continue;
      east = glm::normalize(RealVec3(-local.z, 0, local.x));
      north = RealVec3(0, 1, 0) - local.y * local;
    }
    const RealVec3 along_u = glm::normalize(linear_ * east), along_up = linear_ * north;
    RealVec3 normal = glm::normalize(glm::cross(along_u, along_up));
    // Outwards is where the centre is not; of a disc or plane, the side of the third axis.
    const RealVec3 outwards = is_sphere() ? world(local) - center_ : linear_[2];
    if (glm::dot(normal, outwards) < 0) normal = -normal;
    EXPECT_LT(glm::length(RealVec3(point.normal_geometric) - normal), 1e-5L);
    EXPECT_EQ(point.normal, point.normal_geometric);
    EXPECT_LT(glm::length(RealVec3(Vec3(point.tangent)) - along_u), 1e-5L);
    // v grows downwards in an image: the bitangent points up.
    const RealVec3 bitangent = RealVec3(point.tangent.w * glm::cross(point.normal, Vec3(point.tangent)));
    EXPECT_GT(glm::dot(bitangent, along_up), 0);
  }
}

TEST_P(Shapes, BoundsAreTight) {
  const Bounds bounds = shape_bounds(shape_);
  if (shape_.kind == ShapeKind::plane) {
    EXPECT_TRUE(bounds.is_empty());
    return;
  }
  const Scene scene = scene_of(shape_);
  Bounds seen;
  Random random(5);
  for (int i = 0; i < 200000; ++i) {
    Vec2 coordinates = random_coordinates(random);
    if (!is_sphere()) coordinates = glm::normalize(coordinates) * (1 - 1e-6f);
    seen.add(shape_surface_point(scene, 0, coordinates).position);
  }
  const Real rounding = 1e-6L * (size_ + glm::length(center_));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(bounds.low[axis], seen.low[axis]);
    EXPECT_GE(bounds.high[axis], seen.high[axis]);
    EXPECT_NEAR(bounds.low[axis], seen.low[axis], 2e-4L * size_ + rounding);
    EXPECT_NEAR(bounds.high[axis], seen.high[axis], 2e-4L * size_ + rounding);
  }
}

// The outline frames a scene: it holds all of a shape and reaches at most a fiftieth further.
TEST_P(Shapes, OutlineHoldsTheShapeClosely) {
  const Scene scene = scene_of(shape_);
  const std::vector<Vec3> outline = scene_outline(scene);
  EXPECT_EQ(outline.empty(), shape_.kind == ShapeKind::plane);
  if (outline.empty()) return;
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const RealVec3 direction(sample_sphere(random.next_2d()));
    Real furthest = -1e30L;
    for (const Vec3 p : outline) furthest = std::max(furthest, glm::dot(RealVec3(p) - center_, direction));
    // Support function: |M^T d| of the sphere, without the third row of the disc.
    RealVec3 row = direction * linear_;
    if (!is_sphere()) row.z = 0;
    const Real reach = glm::length(row), rounding = 1e-6L * (size_ + glm::length(center_));
    EXPECT_GE(furthest, reach - rounding);
    EXPECT_LE(furthest, 1.02L * reach + rounding);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Shapes, testing::ValuesIn(shape_samples()),
                         [](const auto& test) { return test.param.name; });

TEST(Shape, OctahedralMapIsItsOwnInverse) {
  Random random(7);
  std::vector<glm::dvec3> directions;
  for (const double x : {-1.0, -0.0, 0.0, 1.0}) {
    for (const double y : {-1.0, -0.0, 0.0, 1.0}) {
      for (const double z : {-1.0, -0.0, 0.0, 1.0}) {
        if (std::abs(x) + std::abs(y) + std::abs(z) > 0) directions.push_back(glm::normalize(glm::dvec3(x, y, z)));
      }
    }
  }
  for (int i = 0; i < 100000; ++i) directions.push_back(glm::normalize(glm::dvec3(sample_sphere(random.next_2d()))));
  for (const glm::dvec3 v : directions) {
    const Vec2 coordinates = unit_to_octahedral(v);
    ASSERT_LE(std::max(std::abs(coordinates.x), std::abs(coordinates.y)), 1);
    const glm::dvec3 back = octahedral_to_unit(coordinates);
    ASSERT_LT(glm::length(back - v), 2e-7);
    ASSERT_NEAR(glm::length(back), 1, 1e-15);
  }
}

Vec2 uv_at(const Scene& scene, Vec2 coordinates) { return shape_surface_point(scene, 0, coordinates).uv[0]; }

// The documented parametrisations at places where they are known.
TEST(Shape, TextureCoordinates) {
  const auto expect_uv = [](Vec2 uv, Vec2 expected) {
    EXPECT_NEAR(uv.x, expected.x, 1e-6f);
    EXPECT_NEAR(uv.y, expected.y, 1e-6f);
  };
  Shape shape;
  const Scene sphere = scene_of(shape);
  const auto on_sphere = [&](glm::dvec3 v) { return uv_at(sphere, unit_to_octahedral(glm::normalize(v))); };
  expect_uv(on_sphere({1, 0, 0}), {0.5f, 0.5f});
  expect_uv(on_sphere({0, 0, 1}), {0.75f, 0.5f});
  expect_uv(on_sphere({0, 0, -1}), {0.25f, 0.5f});
  expect_uv(on_sphere({1, 1, 0}), {0.5f, 0.25f});  // 45 degrees up
  expect_uv(on_sphere({0, 1e-9, 1}), {0.75f, 0.5f});
  EXPECT_EQ(on_sphere({0, 1, 0}).y, 0);
  EXPECT_EQ(on_sphere({0, -1, 0}).y, 1);
  shape.kind = ShapeKind::plane;
  expect_uv(uv_at(scene_of(shape), {2.5f, -1.25f}), {2.5f, 1.25f});
  shape.kind = ShapeKind::disc;
  expect_uv(uv_at(scene_of(shape), {0.5f, 0.5f}), {0.75f, 0.25f});
  Scene plain = scene_of(shape);
  plain.materials[0].base_color_texture.texture = invalid_id;
  EXPECT_EQ(uv_at(plain, {0.5f, 0.5f}), Vec2(0)) << "not looked up";
}

// At and around the poles and the seam everything is finite and in its range.
TEST(Shape, PolesAndSeamAreSound) {
  const Scene scene = scene_of(Shape{});
  for (const double x : {-1.0, -1e-7, -1e-30, -0.0, 0.0, 1e-30, 1e-7, 1.0}) {
    for (const double y : {-1.0, -1e-7, 0.0, 1e-7, 1.0}) {
      for (const double z : {-1.0, -1e-7, -1e-30, -0.0, 0.0, 1e-30, 1e-7, 1.0}) {
        if (std::abs(x) + std::abs(y) + std::abs(z) < 1e-20) continue;
        const Vec2 coordinates = unit_to_octahedral(glm::normalize(glm::dvec3(x, y, z)));
        const SurfacePoint point = shape_surface_point(scene, 0, coordinates);
        EXPECT_TRUE(point.uv[0].x >= 0 && point.uv[0].x <= 1) << point.uv[0].x;
        EXPECT_TRUE(point.uv[0].y >= 0 && point.uv[0].y <= 1) << point.uv[0].y;
        EXPECT_NEAR(glm::length(Vec3(point.tangent)), 1, 1e-6f);
        EXPECT_NEAR(glm::dot(Vec3(point.tangent), point.normal), 0, 1e-6f);
        EXPECT_NEAR(glm::length(point.normal), 1, 1e-6f);
        EXPECT_TRUE(is_finite(point.position));
      }
    }
  }
}

// Bounds join those of meshes, planes do not count; a shape that emits more than 1 nit is a light; none is a triangle.
TEST(Shape, CountsInTheScene) {
  Scene scene = scene_of({"", ShapeKind::sphere, {Mat3(2), Vec3(5, 0, 0)}, 0});
  scene.shapes.push_back({"", ShapeKind::disc, {Mat3(1), Vec3(0, 0, -9)}, 0});
  scene.shapes.push_back({"", ShapeKind::plane, {Mat3(1), Vec3(0, 0, 100)}, 0});
  const Bounds bounds = scene_bounds(scene);
  EXPECT_LT(glm::length(bounds.low - Vec3(-1, -2, -9)), 1e-5f);
  EXPECT_LT(glm::length(bounds.high - Vec3(7, 2, 2)), 1e-5f);
  EXPECT_EQ(instanced_triangle_count(scene), 0u);
  EXPECT_FALSE(has_light(scene));
  scene.materials[0].emission = Vec3(1);
  EXPECT_FALSE(has_light(scene)) << "glows, but lights nothing";
  scene.materials[0].emission = Vec3(0, 1.5f, 0);
  EXPECT_TRUE(has_light(scene));
}

TEST(Shape, PlanesEndFarBeyondAllScenes) {
  const ShapeIntersector plane({"", ShapeKind::plane, {}, 0});
  const auto count = [&](float rise) { return plane.crossings({Vec3(0, 0, 1), Vec3(1, 0, rise)}, infinity).count; };
  EXPECT_EQ(count(-1e-15f), 1);
  EXPECT_EQ(count(-1e-18f), 0) << "at 1e18 m";
}

TEST(Shape, FlatOrBrokenTransformsAreNotThere) {
  Mat3 flat(1), broken(1), overflowing(1e38f);
  flat[2] = Vec3(0);
  broken[1][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(is_invertible({flat, Vec3(0)}));
  EXPECT_FALSE(is_invertible({broken, Vec3(0)}));
  EXPECT_FALSE(is_invertible({Mat3(1), Vec3(infinity, 0, 0)}));
  EXPECT_TRUE(is_invertible({Mat3(1e-12f), Vec3(0)})) << "small is not flat";
  EXPECT_TRUE(is_invertible({overflowing, Vec3(0)}));
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::disc, ShapeKind::plane}) {
    EXPECT_TRUE(shape_bounds({"", kind, {flat, Vec3(0)}, 0}).is_empty());
    Random random(8);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{sample_sphere(random.next_2d()), sample_sphere(random.next_2d())};
      EXPECT_EQ(ShapeIntersector({"", kind, {broken, Vec3(0)}, 0}).crossings(ray, infinity).count, 0);
    }
  }
}

}  // namespace
}  // namespace candil::test
