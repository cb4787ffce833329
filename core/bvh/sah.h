/// A binary hierarchy by the surface area heuristic: ordered traversal that prunes by distance, triangles in the order
/// of the leaves, tested four at a time.
#pragma once

#include <span>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/mesh_part.h"
#include "core/bvh/node_pair.h"
#include "core/bvh/triangle_group.h"

namespace candil {

class SahTriangles {
 public:
  static SahTriangles build(std::span<const MeshPart> parts, const AcceleratorOptions& options);

  template <typename Accept>
  void intersect(const Ray& ray, TriangleHit& nearest, const Accept& accept) const {
    const GroupRay group_ray(ray);
    walk_nearest_first(pairs_, ray, nearest.t, [&](std::uint32_t first, std::uint32_t count, float& t_max) {
      group_ray.cross(group(first), count, t_max, [&](std::uint32_t lane, const TriangleCrossing& crossing) {
        if (crossing.t > t_max) return;
        const TriangleHit candidate = hit(first + lane, crossing);
        if (needs_filter(candidate) && !accept(candidate, crossing.is_front_face)) return;
        nearest = candidate;
      });
    });
  }

  template <typename Accept>
  bool occluded(const Ray& ray, float t_max, const Accept& accept) const {
    const GroupRay group_ray(ray);
    return walk_to_any(pairs_, ray, t_max, [&](std::uint32_t first, std::uint32_t count) {
      bool is_hit = false;
      group_ray.cross(group(first), count, t_max, [&](std::uint32_t lane, const TriangleCrossing& crossing) {
        const TriangleHit candidate = hit(first + lane, crossing);
        is_hit = is_hit || !needs_filter(candidate) || accept(candidate, crossing.is_front_face);
      });
      return is_hit;
    });
  }

  std::size_t memory_bytes() const;

 private:
  const float* group(std::uint32_t first) const { return vertices_.data() + std::size_t{9} * first; }
  TriangleHit hit(std::uint32_t index, const TriangleCrossing& crossing) const {
    return {crossing.t, crossing.barycentric, ids_[index].part, ids_[index].triangle};
  }
  bool needs_filter(const TriangleHit& hit) const { return has_filters_ && needs_filter_[hit.part]; }

  std::vector<NodePair> pairs_;
  std::vector<float> vertices_;     // a group per leaf, see core/bvh/triangle_group.h
  std::vector<TriangleId> ids_;     // in the order of the leaves
  std::vector<bool> needs_filter_;  // per part
  bool has_filters_ = false;
};

class SahBoxes {
 public:
  static SahBoxes build(std::span<const Bounds> boxes, const AcceleratorOptions& options);

  template <typename Visit>
  void intersect(const Ray& ray, float& t_max, const Visit& visit) const {
    walk_nearest_first(pairs_, ray, t_max, [&](std::uint32_t first, std::uint32_t count, float& t_end) {
      for (std::uint32_t i = first; i < first + count; ++i) visit(order_[i], t_end);
    });
  }

  template <typename Visit>
  bool occluded(const Ray& ray, float t_max, const Visit& visit) const {
    return walk_to_any(pairs_, ray, t_max, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i) {
        if (visit(order_[i])) return true;
      }
      return false;
    });
  }

  std::size_t memory_bytes() const;

 private:
  std::vector<NodePair> pairs_;
  std::vector<std::uint32_t> order_;
};

}  // namespace candil
