/// Items with boxes (instances, shapes) in a hierarchy of eight children per node; each item is a leaf.
#pragma once

#include <span>

#include "core/accelerator.h"
#include "core/bvh/wide_build.h"
#include "core/bvh/wide_kernels.h"

namespace candil {

template <typename Node>
class WideBoxes {
 public:
  static WideBoxes build(std::span<const Bounds> boxes, const AcceleratorOptions& options);

  template <typename Visit>
  void intersect(const Ray& ray, float& t_max, const Visit& visit) const {
    functions_->visit_items(nodes_.data(), bounds_, ray, t_max, visit);
  }
  template <typename Visit>
  bool occluded(const Ray& ray, float t_max, const Visit& visit) const {
    return functions_->any_item(nodes_.data(), bounds_, ray, t_max, visit);
  }
  std::size_t memory_bytes() const { return nodes_.bytes(); }

 private:
  const WideFunctions<Node>* functions_ = nullptr;
  LargeBuffer<Node> nodes_;
  Bounds bounds_;
};

extern template class WideBoxes<WideNode>;
extern template class WideBoxes<CompactNode>;

}  // namespace candil
