#include "core/bvh/sah.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/bvh/binned_build.h"

namespace candil {
namespace {

std::uint32_t bin_count(BuildQuality quality) {
  switch (quality) {
    case BuildQuality::low:
      return 8;
    case BuildQuality::medium:
      return 16;
    case BuildQuality::high:
      break;
  }
  return 64;
}

template <typename T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace

SahTriangles SahTriangles::build(std::span<const MeshPart> parts, const AcceleratorOptions& options) {
  SahTriangles sah;
  for (const MeshPart& part : parts) {
    sah.needs_filter_.push_back(part.needs_filter);
    sah.has_filters_ = sah.has_filters_ || part.needs_filter;
  }
  const TriangleList list = list_triangles(parts);
  BinaryTree tree = build_binned(list.bounds, {.bins = bin_count(options.quality), .max_leaf = max_group_size});
  sah.pairs_ = std::move(tree.pairs);
  sah.ids_.resize(list.ids.size());
  sah.vertices_.resize(9 * list.ids.size() + group_padding);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sah.pairs_.size(), 1024), [&](const auto& range) {
    for (std::size_t pair = range.begin(); pair < range.end(); ++pair) {
      for (const NodeLink link : sah.pairs_[pair].links) {
        for (std::uint32_t i = 0; i < link.count(); ++i) {
          const TriangleId id = sah.ids_[link.index() + i] = list.ids[tree.order[link.index() + i]];
          const Corners corners = corners_of(*parts[id.part].mesh, id.triangle);
          float* group = sah.vertices_.data() + std::size_t{9} * link.index();
          set_in_group(group, link.count(), i, corners.a, corners.b, corners.c);
        }
      }
    }
  });
  return sah;
}

std::size_t SahTriangles::memory_bytes() const {
  return bytes_of(pairs_) + bytes_of(vertices_) + bytes_of(ids_) + needs_filter_.capacity() / 8;
}

SahBoxes SahBoxes::build(std::span<const Bounds> boxes, const AcceleratorOptions& options) {
  BinaryTree tree = build_binned(boxes, {.bins = bin_count(options.quality), .max_leaf = 1});
  SahBoxes sah;
  sah.pairs_ = std::move(tree.pairs);
  sah.order_ = std::move(tree.order);
  return sah;
}

std::size_t SahBoxes::memory_bytes() const { return bytes_of(pairs_) + bytes_of(order_); }

}  // namespace candil
