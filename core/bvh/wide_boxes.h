/// Items with boxes (instances, shapes) in a hierarchy of eight children per node; each item is a leaf.
#pragma once

#include <span>

#include "core/accelerator.h"
#include "core/bvh/compact_node.h"
#include "core/bvh/wide_build.h"
#include "core/bvh/wide_traverse.h"

namespace candil {

template <typename Node>
class WideBoxes {
 public:
  static WideBoxes build(std::span<const Bounds> boxes, BuildQuality quality);

  template <typename Visit>
  void intersect(const Ray& ray, float& t_max, const Visit& visit) const {
    visit_nearest_first(nodes_.data(), WideRay(ray, bounds_), t_max,
                        [&](std::uint32_t item, float& t_end) { visit(item, t_end); });
  }
  template <typename Visit>
  bool occluded(const Ray& ray, float t_max, const Visit& visit) const {
    return visit_until(nodes_.data(), WideRay(ray, bounds_), t_max, [&](std::uint32_t item) { return visit(item); });
  }
  std::size_t memory_bytes() const { return nodes_.bytes(); }

 private:
  LargeBuffer<Node> nodes_;
  Bounds bounds_;
};

extern template class WideBoxes<WideNode>;
extern template class WideBoxes<CompactNode>;

}  // namespace candil
