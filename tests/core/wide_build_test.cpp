// Trees of eight children: that they hold everything once, in its box, and are no deeper than a ray's stack.
#include "core/bvh/wide_build.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "core/bvh/binary_bins.h"
#include "core/bvh/wide_boxes.h"
#include "core/bvh/wide_traverse.h"

namespace candil {
namespace {

constexpr TreeSettings medium{};
constexpr TreeSettings fine{.unsplit_size = 1, .bins = max_bins, .moves_subtrees = true};
constexpr TreeSettings single{.leaf_cost = 4, .max_leaf_size = 1, .unsplit_size = 1};
constexpr TreeSettings fine_single{.leaf_cost = 4, .max_leaf_size = 1, .unsplit_size = 1, .moves_subtrees = true};

std::vector<PrimitiveRef> make_refs(const std::vector<Bounds>& boxes) {
  std::vector<PrimitiveRef> refs;
  for (const Bounds& box : boxes) refs.emplace_back(FlippedBox(box), static_cast<std::uint32_t>(refs.size()));
  return refs;
}

std::vector<Bounds> random_boxes(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<Bounds> boxes(count);
  for (Bounds& box : boxes) {
    const float x = unit(random), y = unit(random), z = unit(random), size = 0.01f * unit(random);
    box = {Vec3(x, y, z), Vec3(x, y, z) + size};
  }
  return boxes;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(outer.low, inner.low)) && glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

/// Walks the whole tree, counts how often each primitive is met, and checks boxes on the way.
class Inspector {
 public:
  Inspector(const WideTree& tree, const std::vector<PrimitiveRef>& refs, const std::vector<Bounds>& boxes)
      : tree_(tree), refs_(refs), boxes_(boxes), times_met(boxes.size()) {
    visit(0, tree.bounds, 1);
  }

 private:
  void visit(std::uint32_t index, const Bounds& around, int level) {
    depth = std::max(depth, level);
    const WideNode& node = tree_.nodes[index];
    for (int i = 0; i < lane_count; ++i) {
      const Bounds box{Vec3(node.planes[0][i], node.planes[2][i], node.planes[4][i]),
                       Vec3(node.planes[1][i], node.planes[3][i], node.planes[5][i])};
      if (box.is_empty()) continue;
      are_boxes_nested &= contains(around, box);
      if ((node.child[i] & WideNode::leaf_bit) == 0) {
        visit(node.child[i], box, level + 1);
        continue;
      }
      const WideLeaf leaf = tree_.leaves[node.child[i] ^ WideNode::leaf_bit];
      largest_leaf = std::max(largest_leaf, leaf.count);
      for (std::uint32_t k = leaf.first; k < leaf.first + leaf.count; ++k) {
        are_boxes_nested &= contains(box, boxes_[refs_[k].id()]);
        ++times_met[refs_[k].id()];
      }
    }
  }

  const WideTree& tree_;
  const std::vector<PrimitiveRef>& refs_;
  const std::vector<Bounds>& boxes_;

 public:
  std::vector<int> times_met;
  bool are_boxes_nested = true;
  int depth = 0;
  std::uint32_t largest_leaf = 0;
};

void expect_sound(const std::vector<Bounds>& boxes) {
  for (const TreeSettings& settings : {medium, fine, single, fine_single}) {
    std::vector<PrimitiveRef> refs = make_refs(boxes);
    const WideTree tree = build_wide_tree(refs, settings);
    const Inspector found(tree, refs, boxes);
    EXPECT_TRUE(std::ranges::all_of(found.times_met, [](int times) { return times == 1; }));
    EXPECT_TRUE(found.are_boxes_nested);
    EXPECT_LE(found.largest_leaf, settings.max_leaf_size);
    EXPECT_LE(found.depth, max_wide_depth);
  }
}

TEST(WideBuild, HoldsEveryPrimitiveOnce) {
  for (const std::size_t count : {1U, 2U, 7U, 8U, 9U, 64U, 65U, 1000U, 30000U, 300000U}) {
    SCOPED_TRACE(count);
    expect_sound(random_boxes(count));
  }
}

TEST(WideBuild, TakesManyOfTheSame) { expect_sound(std::vector<Bounds>(100000, Bounds{Vec3(1), Vec3(2)})); }

TEST(WideBuild, TakesBoxesWithoutVolume) {
  std::vector<Bounds> boxes = random_boxes(20000);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].high[static_cast<int>(i % 3)] = boxes[i].low[static_cast<int>(i % 3)];
    if (i % 4 == 0) boxes[i].high = boxes[i].low;
    if (i % 5 == 0) boxes[i].low.y = boxes[i].high.y = 0;
  }
  expect_sound(boxes);
}

// Sizes and distances in a geometric series: the heuristic cuts off the largest few each time, level after level. With
// a ratio of 0.7, 400 boxes span all of float's range; several at each place make them many.
TEST(WideBuild, BoundsTheDepthOfASeries) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 400; ++i) {
    const float size = 1e30f * std::pow(0.7f, static_cast<float>(i));
    for (int copy = 0; copy < 20; ++copy) boxes.push_back({Vec3(size), Vec3(1.1f * size)});
  }
  expect_sound(boxes);
}

TEST(WideBuild, AnswersNothingForNothing) {
  const WideTree tree = build_wide_tree({}, medium);
  float t_max = infinity;
  int leaves = 0;
  visit_nearest_first(tree.nodes.data(), WideRay({Vec3(0), Vec3(0, 0, 1)}, tree.bounds), t_max,
                      [&](std::uint32_t, float&) { ++leaves; });
  EXPECT_EQ(leaves, 0);
}

// Ranges of above 2^16 boxes are split by several threads.
TEST(WideBuild, MakesTheSameTreeOnAnyNumberOfThreads) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 8);
  const std::vector<Bounds> boxes = random_boxes(300000);
  const auto build = [&](int threads) {
    std::vector<PrimitiveRef> refs = make_refs(boxes);
    WideTree tree;
    tbb::task_arena arena(threads);
    arena.execute([&] { tree = build_wide_tree(refs, fine); });
    return std::pair(std::move(tree), std::move(refs));
  };
  const auto [tree, refs] = build(1);
  for (const int threads : {2, 3, 8}) {
    const auto [other, other_refs] = build(threads);
    ASSERT_EQ(other.nodes.size(), tree.nodes.size());
    ASSERT_EQ(other.leaves.size(), tree.leaves.size());
    EXPECT_EQ(std::memcmp(other.nodes.data(), tree.nodes.data(), tree.nodes.bytes()), 0);
    EXPECT_EQ(std::memcmp(other.leaves.data(), tree.leaves.data(), tree.leaves.bytes()), 0);
    EXPECT_EQ(std::memcmp(other_refs.data(), refs.data(), refs.size() * sizeof(PrimitiveRef)), 0);
  }
}

template <typename Node>
class WideBoxesOf : public testing::Test {};
using NodeKinds = testing::Types<WideNode, CompactNode>;
TYPED_TEST_SUITE(WideBoxesOf, NodeKinds);

// Items in the order of distance, and none behind t_max: rays along x through a row of boxes with gaps.
TYPED_TEST(WideBoxesOf, EitherNodeAreVisitedNearestFirst) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back({Vec3(2 * i, 0, 0), Vec3(2 * i + 1, 1, 1)});
  const auto wide = WideBoxes<TypeParam>::build(boxes, AcceleratorOptions{});
  for (const bool is_forwards : {true, false}) {
    const Ray ray{Vec3(is_forwards ? -1 : 200, 0.5f, 0.5f), Vec3(is_forwards ? 1 : -1, 0, 0)};
    float t_max = 100;  // box i begins at 2 i + 1 forwards, at 199 - 2 i backwards: 0 to 49, or 99 down to 50
    std::vector<std::uint32_t> visited;
    wide.intersect(ray, t_max, [&](std::uint32_t item, float&) { visited.push_back(item); });
    ASSERT_EQ(visited.size(), 50U);
    // Keys of distance have 8 bits: boxes within 1/128 of their distance may change places, never more than one.
    for (std::size_t i = 0; i < visited.size(); ++i) {
      const int place = is_forwards ? static_cast<int>(visited[i]) : 99 - static_cast<int>(visited[i]);
      EXPECT_NEAR(place, static_cast<int>(i), 1);
    }
    const auto is_item = [&](std::uint32_t wanted) { return [=](std::uint32_t item) { return item == wanted; }; };
    EXPECT_TRUE(wide.occluded(ray, 100, is_item(is_forwards ? 3 : 96)));
    EXPECT_FALSE(wide.occluded(ray, 100, is_item(is_forwards ? 60 : 40)));
  }
}

// Rays in the planes of the faces, along edges and through corners of a box, components of +0 and -0: always inside.
TYPED_TEST(WideBoxesOf, EitherNodeAreEnteredInTheirFaces) {
  const Bounds box{Vec3(-1, 2, 5), Vec3(1, 3, 9)};
  const auto wide = WideBoxes<TypeParam>::build(std::vector<Bounds>{box}, AcceleratorOptions{});
  const auto is_entered = [&](Vec3 through, Vec3 direction) {
    return wide.occluded({through - 20.0f * direction, direction}, infinity, [](std::uint32_t) { return true; });
  };
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at = box.corner(corner);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const Vec3 direction(x, y, z);
          if (direction == Vec3(0)) continue;
          EXPECT_TRUE(is_entered(at, direction)) << corner << ' ' << x << y << z;
          EXPECT_TRUE(is_entered(
              at, Vec3(x == 0 ? -0.0f : direction.x, y == 0 ? -0.0f : direction.y, z == 0 ? -0.0f : direction.z)))
              << corner << ' ' << x << y << z;
        }
      }
    }
  }
  EXPECT_FALSE(is_entered(Vec3(0, 3.001f, 7), Vec3(1, 0, 0)));
  EXPECT_FALSE(is_entered(Vec3(0, 1.999f, 7), Vec3(0, 0, -1)));
}

}  // namespace
}  // namespace candil
