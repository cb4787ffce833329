/// No hierarchy at all: every triangle, one after the other, in double precision. The oracle of the others.
#pragma once

#include <span>
#include <vector>

#include "core/accelerator.h"
#include "core/bvh/mesh_part.h"
#include "core/bvh/triangle_test.h"

namespace candil {

class BruteTriangles {
 public:
  static BruteTriangles build(std::span<const MeshPart> parts, const AcceleratorOptions& /*options*/) {
    BruteTriangles brute;
    brute.parts_.assign(parts.begin(), parts.end());
    return brute;
  }

  template <typename Accept>
  void intersect(const Ray& ray, TriangleHit& nearest, const Accept& accept) const {
    for_each_crossing(ray, nearest.t, [&](const TriangleHit& candidate, bool is_front_face) {
      if (candidate.t > nearest.t) return false;
      if (parts_[candidate.part].needs_filter && !accept(candidate, is_front_face)) return false;
      nearest = candidate;
      return false;
    });
  }

  template <typename Accept>
  bool occluded(const Ray& ray, float t_max, const Accept& accept) const {
    return for_each_crossing(ray, t_max, [&](const TriangleHit& candidate, bool is_front_face) {
      return !parts_[candidate.part].needs_filter || accept(candidate, is_front_face);
    });
  }

  std::size_t memory_bytes() const { return parts_.size() * sizeof(MeshPart); }

 private:
  /// Until `visit` answers true; tells whether it did.
  template <typename Visit>
  bool for_each_crossing(const Ray& ray, float t_max, const Visit& visit) const {
    const RayFrame<double> frame(ray);
    for (std::uint32_t part = 0; part < parts_.size(); ++part) {
      const Mesh& mesh = *parts_[part].mesh;
      for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle triangle = mesh.triangles[i];
        TriangleCrossing crossing;
        if (!cross_triangle(frame, mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z],
                            t_max, crossing)) {
          continue;
        }
        if (visit(TriangleHit{crossing.t, crossing.barycentric, part, i}, crossing.is_front_face)) return true;
      }
    }
    return false;
  }

  std::vector<MeshPart> parts_;
};

/// Every item is visited, whatever its box.
class BruteBoxes {
 public:
  static BruteBoxes build(std::span<const Bounds> boxes, const AcceleratorOptions& /*options*/) {
    BruteBoxes brute;
    brute.count_ = static_cast<std::uint32_t>(boxes.size());
    return brute;
  }

  template <typename Visit>
  void intersect(const Ray& /*ray*/, float& t_max, const Visit& visit) const {
    for (std::uint32_t item = 0; item < count_; ++item) visit(item, t_max);
  }

  template <typename Visit>
  bool occluded(const Ray& /*ray*/, float /*t_max*/, const Visit& visit) const {
    for (std::uint32_t item = 0; item < count_; ++item) {
      if (visit(item)) return true;
    }
    return false;
  }

  std::size_t memory_bytes() const { return 0; }

 private:
  std::uint32_t count_ = 0;
};

}  // namespace candil
