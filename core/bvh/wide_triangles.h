/// Triangles in a hierarchy of eight children per node and up to eight triangles per leaf.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/compact_node.h"
#include "core/bvh/mesh_part.h"
#include "core/bvh/triangle_block.h"
#include "core/bvh/wide_build.h"
#include "core/bvh/wide_traverse.h"

namespace candil {

template <typename Node>
class WideTriangles {
 public:
  static WideTriangles build(std::span<const MeshPart> parts, BuildQuality quality);

  template <typename Accept>
  void intersect(const Ray& ray, TriangleHit& nearest, const Accept& accept) const {
    const WideRay wide_ray(ray, bounds_);
    const BlockRay block_ray(ray);
    std::uint32_t found = invalid_id;
    visit_nearest_first(nodes_.data(), wide_ray, nearest.t, [&](std::uint32_t leaf, float& t_max) {
      const TriangleBlock& block = blocks_[leaf];
      const BlockCrossings crossings(block, block_ray, t_max);
      for (unsigned left = crossings.hits(); left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        const float t = crossings.t(lane);
        if (!(t <= t_max)) continue;  // behind another one of this block
        if (block.id[lane] & TriangleBlock::filter_bit) {
          TriangleHit candidate{t, crossings.barycentric(lane)};
          name(candidate, block.id[lane]);
          if (!accept(candidate, crossings.is_front_face(lane))) continue;
        }
        t_max = t;
        nearest.barycentric = crossings.barycentric(lane);
        found = block.id[lane];
      }
    });
    if (found != invalid_id) name(nearest, found);
  }

  template <typename Accept>
  bool occluded(const Ray& ray, float t_max, const Accept& accept) const {
    const WideRay wide_ray(ray, bounds_);
    const BlockRay block_ray(ray);
    return visit_until(nodes_.data(), wide_ray, t_max, [&](std::uint32_t leaf) {
      const TriangleBlock& block = blocks_[leaf];
      const BlockCrossings crossings(block, block_ray, t_max);
      for (unsigned left = crossings.hits(); left != 0; left &= left - 1) {
        const int lane = std::countr_zero(left);
        if ((block.id[lane] & TriangleBlock::filter_bit) == 0) return true;
        TriangleHit candidate{crossings.t(lane), crossings.barycentric(lane)};
        name(candidate, block.id[lane]);
        if (accept(candidate, crossings.is_front_face(lane))) return true;
      }
      return false;
    });
  }

  std::size_t memory_bytes() const {
    return nodes_.bytes() + blocks_.bytes() + first_id_.size() * sizeof(std::uint32_t);
  }

 private:
  /// Triangles of all parts are counted through.
  void name(TriangleHit& hit, std::uint32_t id) const {
    id &= ~TriangleBlock::filter_bit;
    hit.part = static_cast<std::uint32_t>(std::upper_bound(first_id_.begin() + 1, first_id_.end(), id) -
                                          first_id_.begin() - 1);
    hit.triangle = id - first_id_[hit.part];
  }

  LargeBuffer<Node> nodes_;
  LargeBuffer<TriangleBlock> blocks_;
  std::vector<std::uint32_t> first_id_;  // per part
  Bounds bounds_;
};

extern template class WideTriangles<WideNode>;
extern template class WideTriangles<CompactNode>;

}  // namespace candil
