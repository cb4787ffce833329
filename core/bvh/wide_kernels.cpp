// Compiled once for each level of x86-64: see core/bvh/target.h and core/CMakeLists.txt.
#include "core/bvh/wide_kernels.h"

#include "core/bvh/wide_traverse.h"

namespace candil {
inline namespace CANDIL_TARGET {

const WideKernels& wide_kernels_of_target();

namespace {

BlockHit hit_of(const TriangleBlock& block, const BlockCrossings& crossings, int lane) {
  return {crossings.t(lane), crossings.barycentric(lane), block.id[lane] & ~TriangleBlock::filter_bit,
          crossings.is_front_face(lane)};
}

template <typename Node>
std::uint32_t nearest_triangle(const Node* nodes, const Bounds& bounds, const TriangleBlock* blocks, const Ray& ray,
                               TriangleHit& nearest, typename WideFunctions<Node>::Accept accept) {
  const BlockRay block_ray(ray);
  std::uint32_t found = invalid_id;
  visit_nearest_first(nodes, WideRay(ray, bounds), nearest.t, [&](std::uint32_t leaf, float& t_max) {
    const TriangleBlock& block = blocks[leaf];
    const BlockCrossings crossings(block, block_ray, t_max);
    for (unsigned left = crossings.hits(); left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      const float t = crossings.t(lane);
      if (!(t <= t_max)) continue;  // behind another one of this block
      if ((block.id[lane] & TriangleBlock::filter_bit) && !accept(hit_of(block, crossings, lane))) continue;
      t_max = t;
      nearest.barycentric = crossings.barycentric(lane);
      found = block.id[lane] & ~TriangleBlock::filter_bit;
    }
  });
  return found;
}

template <typename Node>
bool any_triangle(const Node* nodes, const Bounds& bounds, const TriangleBlock* blocks, const Ray& ray, float t_max,
                  typename WideFunctions<Node>::Accept accept) {
  const BlockRay block_ray(ray);
  return visit_until(nodes, WideRay(ray, bounds), t_max, [&](std::uint32_t leaf) {
    const TriangleBlock& block = blocks[leaf];
    const BlockCrossings crossings(block, block_ray, t_max);
    for (unsigned left = crossings.hits(); left != 0; left &= left - 1) {
      const int lane = std::countr_zero(left);
      if ((block.id[lane] & TriangleBlock::filter_bit) == 0 || accept(hit_of(block, crossings, lane))) return true;
    }
    return false;
  });
}

template <typename Node>
void visit_items(const Node* nodes, const Bounds& bounds, const Ray& ray, float& t_max,
                 typename WideFunctions<Node>::VisitItem visit) {
  visit_nearest_first(nodes, WideRay(ray, bounds), t_max, visit);
}

template <typename Node>
bool any_item(const Node* nodes, const Bounds& bounds, const Ray& ray, float t_max,
              typename WideFunctions<Node>::AskItem ask) {
  return visit_until(nodes, WideRay(ray, bounds), t_max, ask);
}

template <typename Node>
constexpr WideFunctions<Node> functions = {nearest_triangle<Node>, any_triangle<Node>, visit_items<Node>,
                                           any_item<Node>};

}  // namespace

const WideKernels& wide_kernels_of_target() {
  static constexpr WideKernels kernels = {functions<WideNode>, functions<CompactNode>};
  return kernels;
}

}  // namespace CANDIL_TARGET
}  // namespace candil
