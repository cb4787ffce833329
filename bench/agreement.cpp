#include "bench/agreement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/denormals.h"
#include "core/frame.h"
#include "core/surface.h"

namespace candil {
namespace {

/// A ray is carried into an object's space by a rounded inverse: three roundings in each of its elements, and those of
/// a sum of four products, of coordinates of all three axes.
constexpr float instance_factor = 4;

float largest_coordinate(Vec3 v) { return max_component(glm::abs(v)); }

class Comparison {
 public:
  Comparison(const Scene& scene, const Accelerator& reference, const Accelerator& other)
      : scene_(scene), reference_(reference), other_(other) {}

  Agreement nearest(std::span<const Ray> rays) const {
    Agreement result;
    std::array<Hit, replay_block_size> expected, found;
    const auto answers = std::span(expected).first(rays.size()), others = std::span(found).first(rays.size());
    reference_.intersect_each(rays, answers);
    other_.intersect_each(rays, others);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ++result.rays;
      if (is_same(rays[i], answers[i], others[i])) continue;
      if (is_right_nearby(rays[i], answers[i], others[i])) {
        // The same primitive is no tie, only less exact than the quick test wants.
        const bool are_hits = !answers[i].is_miss() && !others[i].is_miss();
        if (!are_hits || !is_same_primitive(answers[i], others[i])) ++result.ties;
      } else {
        result += {0, 0, 1, Mismatch{rays[i], false, answers[i], others[i]}};
      }
    }
    return result;
  }

  Agreement shadows(std::span<const Ray> rays) const {
    Agreement result;
    for (const Ray& ray : rays) {
      ++result.rays;
      const bool expected = reference_.occluded(ray), found = other_.occluded(ray);
      if (expected == found) continue;
      if (is_shadow_tie(ray, found)) {
        ++result.ties;
      } else {
        result += {0, 0, 1, Mismatch{ray, true, blocked(expected), blocked(found)}};
      }
    }
    return result;
  }

 private:
  static Hit blocked(bool is_blocked) {
    Hit hit;
    if (is_blocked) hit.t = 0;
    return hit;
  }

  static bool is_same_primitive(const Hit& a, const Hit& b) {
    return a.triangle == b.triangle && a.mesh == b.mesh && a.instance == b.instance;
  }

  /// Metres that the ray and what it hits may be off, at the least.
  static float least_error(const Ray& ray, const Hit& hit) {
    const float end = largest_coordinate(ray.origin + hit.t * ray.direction);
    return agreement_tolerance * std::max(end, largest_coordinate(ray.origin));
  }

  /// All of it: vertices and instances may be far from the hit.
  float error_of(const Ray& ray, const Hit& hit) const {
    if (hit.is_miss()) return 0;
    const float of_surface = make_surface_point(scene_, hit).offset * (agreement_tolerance / surface_offset(1));
    const float error = std::max(least_error(ray, hit), of_surface);
    const bool is_carried = !hit.is_shape() && !scene_.instances[hit.instance].is_world_space;
    return is_carried ? instance_factor * error : error;
  }

  static bool is_same(const Ray& ray, const Hit& a, const Hit& b) {
    if (a.is_miss() || b.is_miss()) return a.is_miss() && b.is_miss();
    constexpr float clearly_the_same_place = 0x1p-14f;
    return is_same_primitive(a, b) && std::abs(a.t - b.t) <= least_error(ray, a) &&
           max_component(Vec3(glm::abs(a.barycentric - b.barycentric), 0)) <= clearly_the_same_place;
  }

  /// By how much a triangle stretches errors of the ray into errors of the place on it, across the ray: a weight is a
  /// distance from an edge over the height above that edge, as seen along the ray, and moves the place by up to the
  /// longest edge. 1 for shapes.
  float conditioning(const Ray& ray, const Hit& hit) const {
    if (hit.is_shape()) return 1;
    Hit corner = hit;
    Vec3 corners[3];
    for (int i = 0; i < 3; ++i) {
      corner.barycentric = {i == 1 ? 1 : 0, i == 2 ? 1 : 0};
      const Vec3 p = make_surface_point(scene_, corner).position - ray.origin;
      corners[i] = p - glm::dot(p, ray.direction) * ray.direction;
    }
    const Vec3 e0 = corners[1] - corners[0], e1 = corners[2] - corners[1], e2 = corners[0] - corners[2];
    const float longest_squared = max_component({length_squared(e0), length_squared(e1), length_squared(e2)});
    return std::max(1.0f, longest_squared / glm::length(glm::cross(e0, e2)));
  }

  /// Whether the place on the primitive is on the ray's line, as the answer claims.
  bool is_on_line(const Ray& ray, const Hit& hit, float error) const {
    const Vec3 offset = make_surface_point(scene_, hit).position - (ray.origin + hit.t * ray.direction);
    const float distance = glm::length(offset - glm::dot(offset, ray.direction) * ray.direction);
    return distance <= 2 * error || distance <= 2 * error * conditioning(ray, hit);
  }

  /// The ray moved by up to `distance`: sideways in eight directions, and along itself in both. Also by parts of it, or
  /// it would jump over what is thin as it sees it.
  static std::array<Ray, 30> moved(const Ray& ray, float distance) {
    std::array<Ray, 30> rays;
    rays.fill(ray);
    const Frame frame(ray.direction);
    auto next = rays.begin();
    for (const float length : {distance, distance / 8, distance / 64}) {
      for (int i = 0; i < 8; ++i) {
        const float angle = 0.25f * pi * static_cast<float>(i);
        next++->origin += length * frame.to_world(Vec3(std::cos(angle), std::sin(angle), 0));
      }
      next++->origin += length * ray.direction;
      next++->origin -= length * ray.direction;
    }
    return rays;
  }

  bool is_right_nearby(const Ray& ray, const Hit& expected, const Hit& found) const {
    const float error = std::max(error_of(ray, expected), error_of(ray, found));
    if (!found.is_miss() && !is_on_line(ray, found, error)) return false;
    if (std::abs(expected.t - found.t) <= error) return true;
    // Between which distances the reference sees the primitive that the other one found.
    float low = infinity, high = -infinity;
    const auto add = [&](const Hit& hit) {
      if (hit.is_miss() || !is_same_primitive(hit, found)) return;
      low = std::min(low, hit.t), high = std::max(high, hit.t);
    };
    add(expected);
    for (const Ray& near : moved(ray, error)) {
      const Hit hit = reference_.intersect(near).value_or(Hit{});
      if (hit.is_miss() && found.is_miss()) return true;
      if (std::abs(hit.t - found.t) <= 2 * error) return true;
      add(hit);
    }
    return low - error <= found.t && found.t <= high + error;
  }

  bool is_shadow_tie(const Ray& ray, bool found) const {
    // What one of them says is in the way tells how exact the answer can be.
    const Hit blocker = (found ? other_ : reference_).intersect(ray).value_or(Hit{});
    const float error = std::max(error_of(ray, blocker), agreement_tolerance * largest_coordinate(ray.origin));
    return std::ranges::any_of(moved(ray, error), [&](const Ray& near) { return reference_.occluded(near) == found; });
  }

  const Scene& scene_;
  const Accelerator& reference_;
  const Accelerator& other_;
};

}  // namespace

Agreement& Agreement::operator+=(const Agreement& other) {
  rays += other.rays, ties += other.ties, mismatches += other.mismatches;
  if (!first_mismatch) first_mismatch = other.first_mismatch;
  return *this;
}

Agreement compare(const Scene& scene, const Accelerator& reference, const Accelerator& other, const RayChoice& choice,
                  RayKind kind, int threads) {
  const Comparison comparison(scene, reference, other);
  std::vector<Agreement> blocks(choice.block_count());
  on_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      const DenormalsAreZero denormals_are_zero;
      blocks[i] = kind == RayKind::shadow ? comparison.shadows(choice.block(i)) : comparison.nearest(choice.block(i));
    });
  });
  Agreement sum;
  for (const Agreement& block : blocks) sum += block;
  return sum;
}

}  // namespace candil
