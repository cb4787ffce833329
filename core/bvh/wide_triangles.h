/// Triangles in a hierarchy of eight children per node and up to eight triangles per leaf.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/wide_build.h"
#include "core/bvh/wide_kernels.h"

namespace candil {

template <typename Node>
class WideTriangles {
 public:
  static WideTriangles build(std::span<const MeshPart> parts, const AcceleratorOptions& options);

  template <typename Accept>
  void intersect(const Ray& ray, TriangleHit& nearest, const Accept& accept) const {
    const std::uint32_t found =
        functions_->nearest_triangle(nodes_.data(), bounds_, blocks_.data(), ray, nearest,
                                     [&](const BlockHit& hit) { return accept(candidate(hit), hit.is_front_face); });
    if (found != invalid_id) name(nearest, found);
  }

  template <typename Accept>
  bool occluded(const Ray& ray, float t_max, const Accept& accept) const {
    return functions_->any_triangle(nodes_.data(), bounds_, blocks_.data(), ray, t_max,
                                    [&](const BlockHit& hit) { return accept(candidate(hit), hit.is_front_face); });
  }

  std::size_t memory_bytes() const {
    return nodes_.bytes() + blocks_.bytes() + first_id_.size() * sizeof(std::uint32_t);
  }

 private:
  TriangleHit candidate(const BlockHit& found) const {
    TriangleHit hit{found.t, found.barycentric};
    name(hit, found.id);
    return hit;
  }
  /// Triangles of all parts are counted through.
  void name(TriangleHit& hit, std::uint32_t id) const {
    hit.part = static_cast<std::uint32_t>(std::upper_bound(first_id_.begin() + 1, first_id_.end(), id) -
                                          first_id_.begin() - 1);
    hit.triangle = id - first_id_[hit.part];
  }

  const WideFunctions<Node>* functions_ = nullptr;
  LargeBuffer<Node> nodes_;
  LargeBuffer<TriangleBlock> blocks_;
  std::vector<std::uint32_t> first_id_;  // per part
  Bounds bounds_;
};

extern template class WideTriangles<WideNode>;
extern template class WideTriangles<CompactNode>;

}  // namespace candil
