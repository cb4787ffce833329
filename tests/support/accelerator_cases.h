/// Scenes and rays that are hard to get right, for the tests of every accelerator.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/accelerator.h"
#include "tests/support/chi_square.h"

namespace candil::test {

/// A kind of accelerator, with the options that decide which code answers.
struct AcceleratorChoice {
  AcceleratorKind kind = AcceleratorKind::embree;
  BuildQuality quality = BuildQuality::medium;
  bool is_compact = false;
  std::string isa = {};

  AcceleratorOptions options() const;
  std::string name() const;  ///< Letters and _.
};

/// All kinds that there are, and wide with each of its options and instruction sets: tests that go through them need no
/// change for a new one.
std::vector<AcceleratorChoice> accelerator_choices();
inline std::string choice_name(const testing::TestParamInfo<AcceleratorChoice>& test) { return test.param.name(); }
std::unique_ptr<Accelerator> make_accelerator_of(const AcceleratorChoice& choice,
                                                 const Scene& scene);  ///< With alpha_filter().

Vec3 random_in_cube(Random& random);  ///< Of half side 1 around the origin.
Vec3 random_direction(Random& random);
std::size_t random_index(Random& random, std::size_t first, std::size_t end);

/// Triangles of random sizes and places in a cube of half side `scale`.
Mesh random_soup(Random& random, int triangle_count, float scale);
/// 100 single-sided, 100 double-sided and 100 transmissive triangles of it.
Scene mixed_soup(float scale, std::uint32_t seed);

/// Origins in and around that cube; every second ray ends somewhere in it.
Ray random_ray(Random& random, float scale);
Ray random_axis_parallel_ray(Random& random, float scale);
/// A ray from anywhere around the unit cube at a random point of a triangle's first edge.
Ray ray_at_edge(Random& random, const Mesh& mesh, std::size_t triangle);

/// A ball of radius 1 whose triangles share their vertices all around: no seam.
Mesh closed_ball(int rows);
/// A box of n x n squares per side, shared vertices, corners at +-half_extent.
Mesh closed_box(Vec3 half_extent, int n);

/// Judges the answers of every kind of accelerator to `ray_count` rays, with and without alpha filter, against
/// BruteForce. At least `decided_share` of the rays must have had one right answer only, and of hits and misses
/// there must be `least_share` each.
void expect_agreement(const Scene& scene, int ray_count, double decided_share,
                      const std::function<Ray(Random&)>& make_ray, double least_share = 0.05);

}  // namespace candil::test
