#include "core/bvh/wide_boxes.h"

#include <tbb/parallel_for.h>

namespace candil {

template <typename Node>
WideBoxes<Node> WideBoxes<Node>::build(std::span<const Bounds> boxes, const AcceleratorOptions& options) {
  LargeBuffer<PrimitiveRef> refs(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    refs[i] = PrimitiveRef(FlippedBox(boxes[i]), static_cast<std::uint32_t>(i));
  }
  // An item costs more than a few nodes, and its own box should decide whether it is looked into.
  TreeSettings settings{.leaf_cost = 4, .max_leaf_size = 1, .unsplit_size = 1};
  settings.moves_subtrees = options.quality == BuildQuality::high;
  WideTree tree = build_wide_tree({refs.data(), refs.size()}, settings);
  tbb::parallel_for(std::size_t{0}, tree.nodes.size(), [&](std::size_t i) {
    for (std::uint32_t& child : tree.nodes[i].child) {
      const std::uint32_t leaf = child ^ WideNode::leaf_bit;
      if (child & WideNode::leaf_bit && leaf < tree.leaves.size()) {
        child = WideNode::leaf_bit | refs[tree.leaves[leaf].first].id();
      }
    }
  });
  WideBoxes result;
  result.functions_ = &wide_kernels(options.isa).of<Node>();
  result.nodes_ = nodes_from<Node>(std::move(tree.nodes));
  result.bounds_ = tree.bounds;
  return result;
}

template class WideBoxes<WideNode>;
template class WideBoxes<CompactNode>;

}  // namespace candil
