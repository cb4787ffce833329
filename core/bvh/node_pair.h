/// A binary hierarchy: nodes of 32 bytes, the two children of a node side by side in one cache line, and the two walks
/// through it: to the nearest hit, and to any.
#pragma once

#include <bit>
#include <vector>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "core/bvh/box_test.h"
#include "core/simd.h"

namespace candil {

/// What a child is: the index of a pair of nodes, or that of the first of 1 to 7 items. In one number, for the stack.
struct NodeLink {
  static constexpr std::uint32_t max_items = 7, max_index = (1U << 29) - 1;

  std::uint32_t bits = 0;

  static NodeLink pair(std::uint32_t index) { return {index << 3}; }
  static NodeLink leaf(std::uint32_t first, std::uint32_t count) { return {first << 3 | count}; }
  bool is_leaf() const { return (bits & 7) != 0; }
  std::uint32_t index() const { return bits >> 3; }
  std::uint32_t count() const { return bits & 7; }
};

/// Two siblings. Boxes lie across: for each axis the low planes of both children, then the high ones.
struct alignas(64) NodePair {
  Float4 planes[3] = {Float4{infinity, infinity, -infinity, -infinity},
                      Float4{infinity, infinity, -infinity, -infinity},
                      Float4{infinity, infinity, -infinity, -infinity}};  // empty boxes, which no ray enters
  NodeLink links[2];
  std::uint32_t padding[2] = {};

  void set(int child, const Bounds& box, NodeLink link) {
    for (int axis = 0; axis < 3; ++axis) planes[axis][child] = box.low[axis], planes[axis][child + 2] = box.high[axis];
    links[child] = link;
  }
};
static_assert(sizeof(NodePair) == 64);

/// How deep a hierarchy may be: so much does the stack of a walk hold.
inline constexpr int max_tree_depth = 96;

/// A ray as the test of two boxes at once wants it.
class PairRay {
 public:
  explicit PairRay(const Ray& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      const float inverse = 1 / ray.direction[axis];
      origin_[axis] = splat(ray.origin[axis]);
      scale_[axis] = Float4{inverse, inverse, -inverse, -inverse};
      const bool is_forwards = !std::signbit(inverse);
      order_[axis] = is_forwards ? Int4{0, 1, 2, 3} : Int4{2, 3, 0, 1};
    }
  }

  struct Entries {
    float near[2];
    int mask;  ///< Bit i: child i is entered.
  };
  /// core/bvh/box_test.h for both children. Far ends are negated, so that one maximum serves both ends.
  Entries enter(const NodePair& pair, float t_max) const {
    Float4 ends = {0, 0, -t_max, -t_max};
    for (int axis = 0; axis < 3; ++axis) {
      const Float4 t = (near_first(pair.planes[axis], axis) - origin_[axis]) * scale_[axis];
      ends = t > ends ? t : ends;  // keeps `ends` where t is not a number
    }
    const float far_0 = -far_slack * ends[2], far_1 = -far_slack * ends[3];
    return {{ends[0], ends[1]}, (ends[0] <= far_0 ? 1 : 0) | (ends[1] <= far_1 ? 2 : 0)};
  }

 private:
  using Int4 = std::int32_t __attribute__((vector_size(16)));

  /// The planes that the ray meets first in lanes 0 and 1.
  Float4 near_first(Float4 planes, int axis) const {
#if defined(__AVX__)
    return Float4(_mm_permutevar_ps(__m128(planes), __m128i(order_[axis])));
#else
    return order_[axis] == Int4{0, 1, 2, 3} ? planes : __builtin_shufflevector(planes, planes, 2, 3, 0, 1);
#endif
  }

  Float4 origin_[3], scale_[3];
  Int4 order_[3];
};

/// Calls `visit(first, count, t_max)` for the leaves that the ray enters before t_max, nearer children first; it may
/// lower t_max.
template <typename Visit>
void walk_nearest_first(const std::vector<NodePair>& pairs, const Ray& ray, float& t_max, const Visit& visit) {
  if (pairs.empty()) return;
  struct Later {
    NodeLink link;
    float near;
  };
  Later stack[max_tree_depth];
  Later* top = stack;
  const PairRay slabs(ray);
  NodeLink link = NodeLink::pair(0);
  while (true) {
    while (!link.is_leaf()) {
      const NodePair& pair = pairs[link.index()];
      const PairRay::Entries entries = slabs.enter(pair, t_max);
      if (entries.mask == 0) {
        link = {};
        break;
      }
      int child = entries.mask >> 1;  // the only one
      if (entries.mask == 3) {
        child = entries.near[1] < entries.near[0];
        *top++ = {pair.links[1 - child], entries.near[1 - child]};
      }
      link = pair.links[child];
    }
    if (link.is_leaf()) visit(link.index(), link.count(), t_max);
    do {
      if (top == stack) return;
      --top;
    } while (top->near > t_max * far_slack);
    link = top->link;
  }
}

/// Calls `visit(first, count)` for the leaves that the ray enters before t_max, until it answers true; tells whether.
template <typename Visit>
bool walk_to_any(const std::vector<NodePair>& pairs, const Ray& ray, float t_max, const Visit& visit) {
  if (pairs.empty()) return false;
  NodeLink stack[max_tree_depth];
  NodeLink* top = stack;
  const PairRay slabs(ray);
  NodeLink link = NodeLink::pair(0);
  while (true) {
    while (!link.is_leaf()) {
      const NodePair& pair = pairs[link.index()];
      const PairRay::Entries entries = slabs.enter(pair, t_max);
      if (entries.mask == 0) {
        link = {};
        break;
      }
      int child = entries.mask >> 1;
      if (entries.mask == 3) {
        child = entries.near[1] < entries.near[0];
        *top++ = pair.links[1 - child];
      }
      link = pair.links[child];
    }
    if (link.is_leaf() && visit(link.index(), link.count())) return true;
    if (top == stack) return false;
    link = *--top;
  }
}

}  // namespace candil
