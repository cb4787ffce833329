/// What rays do in hierarchies of WideNodes or CompactNodes, compiled for each level of x86-64 from that of the rest of
/// the program on: the best one that the processor has is taken when the program runs.
#pragma once

#include <string_view>

#include "core/bvh/compact_node.h"
#include "core/bvh/function_ref.h"
#include "core/bvh/mesh_part.h"
#include "core/bvh/triangle_block.h"

namespace candil {

/// A triangle that a ray crosses.
struct BlockHit {
  float t;
  Vec2 barycentric;  ///< Weights of the second and the third vertex.
  std::uint32_t id;  ///< Without TriangleBlock::filter_bit.
  bool is_front_face;
};

/// The functions for one kind of node. `nodes` has one at least, `bounds` holds all of them. Leaves are indices into
/// `blocks`, or items of the caller.
template <typename Node>
struct WideFunctions {
  using Accept = FunctionRef<bool(const BlockHit&)>;
  using VisitItem = FunctionRef<void(std::uint32_t, float&)>;
  using AskItem = FunctionRef<bool(std::uint32_t)>;

  /// The id of the nearest triangle with t in [0, nearest.t], of which `nearest` gets t and barycentric coordinates;
  /// invalid_id for none. `accept` is asked for triangles with filter_bit.
  std::uint32_t (*nearest_triangle)(const Node* nodes, const Bounds& bounds, const TriangleBlock* blocks,
                                    const Ray& ray, TriangleHit& nearest, Accept accept);
  /// Whether there is one with t in [0, t_max].
  bool (*any_triangle)(const Node* nodes, const Bounds& bounds, const TriangleBlock* blocks, const Ray& ray,
                       float t_max, Accept accept);
  /// visit_nearest_first() and visit_until() of core/bvh/wide_traverse.h.
  void (*visit_items)(const Node* nodes, const Bounds& bounds, const Ray& ray, float& t_max, VisitItem visit);
  bool (*any_item)(const Node* nodes, const Bounds& bounds, const Ray& ray, float t_max, AskItem ask);
};

struct WideKernels {
  WideFunctions<WideNode> of_wide_nodes;
  WideFunctions<CompactNode> of_compact_nodes;

  template <typename Node>
  const WideFunctions<Node>& of() const {
    if constexpr (std::is_same_v<Node, WideNode>) {
      return of_wide_nodes;
    } else {
      return of_compact_nodes;
    }
  }
};

/// Those for an instruction set of wide_instruction_sets(); empty: the best that the processor has. Throws
/// std::runtime_error where the build or the processor does not have it.
const WideKernels& wide_kernels(std::string_view isa);

}  // namespace candil
