#include "core/bvh/compact_node.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace candil {
namespace {

bool is_used(const WideNode& wide, int lane) { return wide.planes[0][lane] <= wide.planes[1][lane]; }

/// No ray hits what reaches to infinity, but it must not be in the way of its neighbours.
double finite(float x) {
  constexpr double most = std::numeric_limits<float>::max();
  return std::clamp<double>(x, -most, most);
}

}  // namespace

CompactNode::CompactNode(const WideNode& wide) {
  for (int lane = 0; lane < lane_count; ++lane) child[lane] = is_used(wide, lane) ? wide.child[lane] : no_child;
  exponents[3] = 0x3f;
  for (int axis = 0; axis < 3; ++axis) {
    const auto &lows = wide.planes[2 * axis], &highs = wide.planes[2 * axis + 1];
    double least = infinity, most = -infinity;
    for (int lane = 0; lane < lane_count; ++lane) {
      if (is_used(wide, lane)) least = std::min(least, finite(lows[lane])), most = std::max(most, finite(highs[lane]));
    }
    if (!(least <= most)) least = most = 0;  // no child
    // 255 steps reach from one to the other. Differences of floats may round in double precision, by less than 2^-53 of
    // the coordinates, which is nothing beside the margin of the ray.
    int exponent = std::ilogb(std::max((most - least) / 255, 0x1p-64));
    if (std::ldexp(255.0, exponent) < most - least) ++exponent;
    low[axis] = static_cast<float>(least);
    exponents[axis] = static_cast<std::uint8_t>(exponent + 127);
    const auto steps = [&](float at) { return std::ldexp(finite(at) - least, -exponent); };
    for (int lane = 0; lane < lane_count; ++lane) {
      const bool has_box = is_used(wide, lane);
      planes[2 * axis][lane] = has_box ? static_cast<std::uint8_t>(std::floor(steps(lows[lane]))) : 255;
      planes[2 * axis + 1][lane] =
          has_box ? static_cast<std::uint8_t>(std::min(255.0, std::ceil(steps(highs[lane])))) : 0;
    }
  }
}

template <>
LargeBuffer<CompactNode> nodes_from(LargeBuffer<WideNode> wide) {
  LargeBuffer<CompactNode> nodes(wide.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) nodes[i] = CompactNode(wide[i]);
  });
  return nodes;
}

}  // namespace candil
