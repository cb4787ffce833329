// Nodes of 8-bit planes: boxes only grow, by less than a step, and rays find in them what they find in exact boxes.
#include "core/bvh/compact_node.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace candil {
namespace {

using Random = std::mt19937;

float between(Random& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

/// Boxes around `middle`, `used` of eight; every fourth is flat along one axis.
WideNode random_node(Random& random, Vec3 middle, float size, int used) {
  WideNode node;
  for (int i = 0; i < lane_count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const float a = middle[axis] + size * between(random, -1, 1), b = middle[axis] + size * between(random, -1, 1);
      const bool is_flat = i % 4 == axis;
      node.planes[2 * axis][i] = i < used ? std::min(a, is_flat ? a : b) : infinity;
      node.planes[2 * axis + 1][i] = i < used ? std::max(a, is_flat ? a : b) : -infinity;
    }
    node.child[i] = i < used ? static_cast<std::uint32_t>(i) : WideNode::leaf_bit;
  }
  return node;
}

double plane(const CompactNode& node, int row, int lane) {
  const int axis = row / 2;
  return node.low[axis] + std::ldexp(node.planes[row][lane], node.exponents[axis] - 127);
}

/// Sizes and places from the smallest to the largest that floats have.
template <typename Check>
void for_each_scale(const Check& check) {
  Random random(1);
  for (const float size : {1e-30f, 1e-10f, 1e-3f, 1.0f, 1e5f, 1e20f, 1e38f}) {
    for (const float offset : {0.0f, 1.0f, 1000.0f}) {
      if (!(size * offset < 1e37f)) continue;
      for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "size " << size << " at " << offset);
        const Vec3 middle =
            offset * size * Vec3(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
        check(random, random_node(random, middle, size, i % 9), middle, size);
      }
    }
  }
}

TEST(CompactNode, HoldsItsChildrenClosely) {
  for_each_scale([](Random&, const WideNode& wide, Vec3, float) {
    const CompactNode node(wide);
    for (int lane = 0; lane < lane_count; ++lane) {
      const bool is_used = wide.planes[0][lane] <= wide.planes[1][lane];
      ASSERT_EQ(node.child[lane], is_used ? wide.child[lane] : CompactNode::no_child);
      if (!is_used) continue;
      for (int row = 0; row < 6; ++row) {
        // Outwards, by less than one step: 2/255 of the extent at most, or 2^-64.
        const double extent = plane(node, row | 1, lane) - node.low[row / 2];
        const double outwards = (row % 2 == 0 ? 1 : -1) * (wide.planes[row][lane] - plane(node, row, lane));
        const double step = std::ldexp(1.0, node.exponents[row / 2] - 127),
                     rounding = 1e-15 * std::abs(node.low[row / 2]);
        ASSERT_GE(outwards, -rounding) << row << ' ' << extent;
        ASSERT_LT(outwards, step + rounding);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      double low = infinity, high = -infinity;
      for (int lane = 0; lane < lane_count; ++lane) {
        low = std::min<double>(low, wide.planes[2 * axis][lane]),
        high = std::max<double>(high, wide.planes[2 * axis + 1][lane]);
      }
      const double step = std::ldexp(1.0, node.exponents[axis] - 127);
      ASSERT_LE(step, std::max(0x1p-64, 2 * (high - low) / 255 * (1 + 1e-12)));
    }
  });
}

// Rays at boxes: the compact node never says no where the full one says yes, and seldom yes where that says no.
TEST(CompactNode, IsEnteredWhereTheFullNodeIs) {
  int entered = 0, more = 0;
  for_each_scale([&](Random& random, const WideNode& wide, Vec3 middle, float size) {
    if (size > 1e30f || size < 1e-20f) return;  // t overflows; steps are larger than the boxes
    const CompactNode node(wide);
    Bounds bounds;
    bounds.add(middle - size), bounds.add(middle + size);
    for (int i = 0; i < 20; ++i) {
      const auto offset = [&] { return Vec3(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)); };
      const Vec3 origin = middle + 3 * size * offset();
      const auto aim = static_cast<std::size_t>(i % lane_count);
      if (node.child[aim] == CompactNode::no_child) continue;
      Vec3 direction;
      for (int axis = 0; axis < 3; ++axis) {
        direction[axis] = between(random, wide.planes[2 * axis][aim], wide.planes[2 * axis + 1][aim]) - origin[axis];
      }
      direction /= max_component(glm::abs(direction));
      if (i % 5 == 0) direction[i % 3] = i % 2 == 0 ? 0.0f : -0.0f;
      const WideRay ray({origin, direction}, bounds);
      const float t_max = i % 2 == 0 ? infinity : 2 * size;
      const Int8 full = enter_children(wide, ray, t_max), compact = enter_children(node, ray, t_max);
      for (int lane = 0; lane < lane_count; ++lane) {
        const bool is_used = node.child[lane] != CompactNode::no_child;
        if (!is_used) {
          ASSERT_EQ(compact[lane], -1);
        } else if (full[lane] >= 0) {
          ++entered;
          ASSERT_GE(compact[lane], 0) << "lane " << lane;
        } else {
          more += compact[lane] >= 0;
        }
      }
    }
  });
  EXPECT_GT(entered, 10000);
  EXPECT_LT(more, entered / 10) << "boxes are much too large";
}

}  // namespace
}  // namespace candil
