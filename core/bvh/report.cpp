#include "core/bvh/report.h"

#include <algorithm>
#include <numeric>

namespace candil {
namespace {

constexpr std::size_t max_leaf = 10;

int widest_axis(const Bounds& box) {
  const Vec3 extent = box.high - box.low;
  return extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
}

}  // namespace

std::uint32_t ReportTree::add_node(std::span<const Bounds> boxes, std::vector<std::uint32_t> items) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node& node = nodes_.emplace_back();
  for (const std::uint32_t item : items) node.box.add(boxes[item].low), node.box.add(boxes[item].high);
  if (items.size() <= max_leaf) {
    node.first = static_cast<std::uint32_t>(items_.size());
    node.count = static_cast<std::uint32_t>(items.size());
    items_.insert(items_.end(), items.begin(), items.end());
    return index;
  }
  const int axis = widest_axis(node.box);
  const auto median = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
  std::nth_element(items.begin(), median, items.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(boxes[a].low[axis], a) < std::pair(boxes[b].low[axis], b);
  });
  std::vector<std::uint32_t> right(median, items.end());
  items.erase(median + 1, items.end());  // the median stays on both sides
  const std::uint32_t left_index = add_node(boxes, std::move(items));
  const std::uint32_t right_index = add_node(boxes, std::move(right));
  nodes_[index].children = {left_index, right_index};
  return index;
}

ReportTree ReportTree::build(std::span<const Bounds> boxes) {
  ReportTree tree;
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0U);
  if (!items.empty()) tree.add_node(boxes, std::move(items));
  return tree;
}

ReportTriangles ReportTriangles::build(std::span<const MeshPart> parts, const AcceleratorOptions& /*options*/) {
  ReportTriangles report;
  report.parts_.assign(parts.begin(), parts.end());
  TriangleList list = list_triangles(parts);
  report.tree_ = ReportTree::build(list.bounds);
  report.ids_ = std::move(list.ids);
  return report;
}

ReportBoxes ReportBoxes::build(std::span<const Bounds> boxes, const AcceleratorOptions& /*options*/) {
  ReportBoxes report;
  report.tree_ = ReportTree::build(boxes);
  return report;
}

}  // namespace candil
