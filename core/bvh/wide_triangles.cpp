#include "core/bvh/wide_triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

#include "core/bvh/binary_bins.h"

namespace candil {
namespace {

Bounds triangle_bounds(const Mesh& mesh, Triangle t) {
  Bounds bounds;
  for (int corner = 0; corner < 3; ++corner) bounds.add(mesh.positions[t[corner]]);
  return bounds;
}

TreeSettings tree_settings(BuildQuality quality) {
  TreeSettings settings;
  if (quality == BuildQuality::low) settings.bins = 8;
  if (quality == BuildQuality::high) settings.bins = max_bins, settings.moves_subtrees = true;
  return settings;
}

}  // namespace

template <typename Node>
WideTriangles<Node> WideTriangles<Node>::build(std::span<const MeshPart> parts, const AcceleratorOptions& options) {
  WideTriangles result;
  std::size_t count = 0;
  for (const MeshPart& part : parts) {
    result.first_id_.push_back(static_cast<std::uint32_t>(count));
    count += part.mesh->triangles.size();
  }
  if (count > max_primitives) throw std::runtime_error("more than 2^29 triangles in one hierarchy");

  LargeBuffer<PrimitiveRef> refs(count);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Mesh& mesh = *parts[p].mesh;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangles.size(), 1 << 12), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const auto id = result.first_id_[p] + static_cast<std::uint32_t>(i);
        refs[id] = PrimitiveRef(FlippedBox(triangle_bounds(mesh, mesh.triangles[i])), id);
      }
    });
  }
  WideTree tree = build_wide_tree({refs.data(), refs.size()}, tree_settings(options.quality));
  result.functions_ = &wide_kernels(options.isa).of<Node>();
  result.blocks_ = LargeBuffer<TriangleBlock>(std::max<std::size_t>(1, tree.leaves.size()));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.leaves.size(), 256), [&](const auto& range) {
    for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf) {
      TriangleBlock& block = result.blocks_[leaf];
      const WideLeaf& from = tree.leaves[leaf];
      Vec3 corners[3] = {};
      for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
        if (lane < from.count) {
          TriangleHit at;
          const std::uint32_t id = refs[from.first + lane].id();
          result.name(at, id);
          const Mesh& mesh = *parts[at.part].mesh;
          for (int corner = 0; corner < 3; ++corner)
            corners[corner] = mesh.positions[mesh.triangles[at.triangle][corner]];
          block.id[lane] = id | (parts[at.part].needs_filter ? TriangleBlock::filter_bit : 0);
        } else {
          std::fill_n(corners, 3, Vec3(std::numeric_limits<float>::quiet_NaN()));
          block.id[lane] = 0;
        }
        for (int corner = 0; corner < 3; ++corner) {
          for (int axis = 0; axis < 3; ++axis) block.vertices[corner][axis][lane] = corners[corner][axis];
        }
      }
    }
  });
  result.nodes_ = nodes_from<Node>(std::move(tree.nodes));
  result.bounds_ = tree.bounds;
  return result;
}

template class WideTriangles<WideNode>;
template class WideTriangles<CompactNode>;

}  // namespace candil
