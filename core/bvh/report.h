/// The hierarchy of the report that candil began from (its section 9.2), as it is described there:
/// - axis-aligned boxes, built from the top: the widest axis of the box is chosen, and the objects are divided at their
///   median along it, by one of the two corners of each object's box. The object at the median goes to both sides.
///   There is no cost function; a node of at most 10 objects is a leaf.
/// - A ray that meets a box looks into both children that it meets, in no order, also where it meets them behind its
///   origin. A hit found already spares nothing: the nearest of all is picked in the end.
/// - There is no other query: whether something is in the way is answered by the nearest hit.
/// It is there to be compared with; see core/bvh/sah.h for what the same structure can do.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/box_test.h"
#include "core/bvh/mesh_part.h"
#include "core/bvh/triangle_test.h"

namespace candil {

class ReportTree {
 public:
  static ReportTree build(std::span<const Bounds> boxes);

  /// Calls `visit(item)` for the items of all leaves whose boxes the line of the ray meets: for some twice.
  template <typename Visit>
  void visit_line(const Ray& ray, const Visit& visit) const {
    if (!nodes_.empty()) visit_line(0, ray, SlabRay(ray), visit);
  }

  std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(std::uint32_t);
  }

 private:
  struct Node {
    Bounds box;
    std::array<std::uint32_t, 2> children{};  // into nodes_; the root is nobody's child: both 0 for a leaf
    std::uint32_t first = 0, count = 0;       // of a leaf, into items_
  };
  std::uint32_t add_node(std::span<const Bounds> boxes, std::vector<std::uint32_t> items);

  template <typename Visit>
  void visit_line(std::uint32_t index, const Ray& ray, const SlabRay& slabs, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (!is_met_by_line(slabs, node.box)) return;
    for (std::uint32_t i = 0; i < node.count; ++i) visit(items_[node.first + i]);
    if (node.children[0] == 0) return;
    visit_line(node.children[0], ray, slabs, visit);
    visit_line(node.children[1], ray, slabs, visit);
  }

  std::vector<Node> nodes_;  // the first one is the root
  std::vector<std::uint32_t> items_;
};

class ReportTriangles {
 public:
  static ReportTriangles build(std::span<const MeshPart> parts, const AcceleratorOptions& options);

  template <typename Accept>
  void intersect(const Ray& ray, TriangleHit& nearest, const Accept& accept) const {
    const RayFrame<float> frame(ray);
    const float t_max = nearest.t;
    tree_.visit_line(ray, [&](std::uint32_t item) {
      const auto [part, triangle] = ids_[item];
      const Corners corners = corners_of(*parts_[part].mesh, triangle);
      TriangleCrossing crossing;
      if (!cross_triangle(frame, corners.a, corners.b, corners.c, t_max, crossing) || crossing.t > nearest.t) return;
      const TriangleHit candidate{crossing.t, crossing.barycentric, part, triangle};
      if (!parts_[part].needs_filter || accept(candidate, crossing.is_front_face)) nearest = candidate;
    });
  }

  template <typename Accept>
  bool occluded(const Ray& ray, float t_max, const Accept& accept) const {
    TriangleHit nearest{.t = t_max};
    intersect(ray, nearest, accept);
    return nearest.part != invalid_id;
  }

  std::size_t memory_bytes() const {
    return tree_.memory_bytes() + ids_.capacity() * sizeof(TriangleId) + parts_.capacity() * sizeof(MeshPart);
  }

 private:
  std::vector<MeshPart> parts_;
  std::vector<TriangleId> ids_;
  ReportTree tree_;
};

class ReportBoxes {
 public:
  static ReportBoxes build(std::span<const Bounds> boxes, const AcceleratorOptions& options);

  template <typename Visit>
  void intersect(const Ray& ray, float& t_max, const Visit& visit) const {
    tree_.visit_line(ray, [&](std::uint32_t item) { visit(item, t_max); });
  }

  template <typename Visit>
  bool occluded(const Ray& ray, float /*t_max*/, const Visit& visit) const {
    bool is_hit = false;
    tree_.visit_line(ray, [&](std::uint32_t item) { is_hit = visit(item) || is_hit; });
    return is_hit;
  }

  std::size_t memory_bytes() const { return tree_.memory_bytes(); }

 private:
  ReportTree tree_;
};

}  // namespace candil
