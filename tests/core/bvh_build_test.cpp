// The binned builder: a sound tree of bounded depth whatever the boxes, and the same one for any number of threads.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/bvh/binned_build.h"
#include "tests/support/accelerator_cases.h"

namespace candil::test {
namespace {

BinnedBuildOptions options_of(std::uint32_t max_leaf) {
  BinnedBuildOptions options;
  options.max_leaf = max_leaf;
  return options;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThanEqual(outer.low, inner.low)) && glm::all(glm::greaterThanEqual(outer.high, inner.high));
}

Bounds box_of(const NodePair& pair, int child) {
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = pair.planes[axis][child], box.high[axis] = pair.planes[axis][child + 2];
  }
  return box;
}

/// What a walk through a whole tree finds.
struct TreeFacts {
  std::vector<int> visits;  ///< Per item.
  int depth = 0;
  std::uint32_t largest_leaf = 0;
  bool is_nested = true;  ///< Every box is within those above it, and holds its items.
};

TreeFacts explore(const BinaryTree& tree, std::span<const Bounds> boxes) {
  TreeFacts facts;
  facts.visits.resize(boxes.size());
  const std::function<void(std::uint32_t, const Bounds&, int)> visit = [&](std::uint32_t index, const Bounds& outer,
                                                                           int depth) {
    facts.depth = std::max(facts.depth, depth);
    for (int child = 0; child < 2; ++child) {
      const Bounds box = box_of(tree.pairs[index], child);
      const NodeLink link = tree.pairs[index].links[child];
      if (box.is_empty()) continue;  // the second child of a root that is a leaf
      facts.is_nested = facts.is_nested && contains(outer, box);
      if (!link.is_leaf()) {
        visit(link.index(), box, depth + 1);
        continue;
      }
      facts.largest_leaf = std::max(facts.largest_leaf, link.count());
      for (std::uint32_t i = link.index(); i < link.index() + link.count(); ++i) {
        ++facts.visits[tree.order[i]];
        facts.is_nested = facts.is_nested && contains(box, boxes[tree.order[i]]);
      }
    }
  };
  const float largest = std::numeric_limits<float>::max();
  if (!tree.pairs.empty()) visit(0, {Vec3(-largest), Vec3(largest)}, 1);
  return facts;
}

void expect_sound(std::span<const Bounds> boxes) {
  for (const std::uint32_t max_leaf : {1U, 4U}) {
    const BinaryTree tree = build_binned(boxes, options_of(max_leaf));
    const TreeFacts facts = explore(tree, boxes);
    EXPECT_TRUE(std::all_of(facts.visits.begin(), facts.visits.end(), [](int n) { return n == 1; }));
    EXPECT_LE(facts.depth, max_tree_depth);
    EXPECT_LE(facts.largest_leaf, max_leaf);
    EXPECT_TRUE(facts.is_nested);
    // Every pair has two children: at most one pair less than leaves.
    EXPECT_LE(tree.pairs.size(), std::max<std::size_t>(boxes.size(), 2) - 1);
  }
}

Bounds random_box(Random& random, float size) {
  const Vec3 center = random_in_cube(random);
  return {center - size * random.next_1d(), center + size * random.next_1d()};
}

TEST(BinnedBuild, OfRandomBoxesIsSound) {
  Random random(1);
  for (const int count : {0, 1, 2, 3, 4, 5, 9, 100, 5000, 100000}) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < count; ++i) boxes.push_back(random_box(random, 0.01f));
    SCOPED_TRACE(count);
    expect_sound(boxes);
  }
}

// Centres in one place, or on one line in distances that grow fourfold, so that every split by bins takes one off.
TEST(BinnedBuild, OfAwkwardBoxesIsSound) {
  Random random(2);
  std::vector<Bounds> same(70000, Bounds{Vec3(-1), Vec3(1)}), concentric, growing;
  for (int i = 0; i < 70000; ++i) {
    const Vec3 half = random_in_cube(random);
    concentric.push_back({-glm::abs(half), glm::abs(half)});
  }
  for (int i = 0; i < 5000; ++i) {
    const float x = std::pow(4.0f, static_cast<float>(i % 60) - 60);
    growing.push_back({Vec3(x, 0, 0), Vec3(x, 0, 0)});
  }
  expect_sound(same);
  expect_sound(concentric);
  expect_sound(growing);
  EXPECT_GT(explore(build_binned(growing, options_of(1)), growing).depth, 30) << "no challenge";
}

// Files with such numbers are refused, but nothing may break: the tree holds every item.
TEST(BinnedBuild, SurvivesNumbersThatAreNone) {
  Random random(3);
  const float values[] = {0, 1, -1, 3e38f, -3e38f, infinity, -infinity, std::nanf("")};
  std::vector<Bounds> boxes;
  for (int i = 0; i < 40000; ++i) {
    const auto value = [&] { return values[random_index(random, 0, std::size(values))]; };
    const Vec3 a(value(), value(), value()), b(value(), value(), value());
    boxes.push_back({a, b});
  }
  const BinaryTree tree = build_binned(boxes, options_of(2));
  std::vector<std::uint32_t> order = tree.order;
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
}

TEST(BinnedBuild, IsTheSameForAnyNumberOfThreads) {
  Random random(4);
  std::vector<Bounds> boxes;
  for (int i = 0; i < 200000; ++i) boxes.push_back(random_box(random, 0.01f));
  const auto build = [&](int threads) {
    BinaryTree tree;
    tbb::task_arena(threads).execute([&] { tree = build_binned(boxes, options_of(4)); });
    return tree;
  };
  const BinaryTree one = build(1);
  for (const int threads : {2, 8}) {
    const BinaryTree many = build(threads);
    EXPECT_EQ(many.order, one.order);
    ASSERT_EQ(many.pairs.size(), one.pairs.size());
    EXPECT_EQ(std::memcmp(many.pairs.data(), one.pairs.data(), one.pairs.size() * sizeof(NodePair)), 0);
  }
}

// A walk visits the items whose boxes the ray enters, all of them and (but for the slack of the box test) no others;
// nearest first prunes what is beyond t_max.
TEST(BinnedBuild, WalksVisitWhatTheRayEnters) {
  Random random(5);
  std::vector<Bounds> boxes;
  for (int i = 0; i < 2000; ++i) boxes.push_back(random_box(random, 0.1f));
  const BinaryTree tree = build_binned(boxes, options_of(1));
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = i % 2 ? random_ray(random, 1) : random_axis_parallel_ray(random, 1);
    std::vector<bool> is_visited(boxes.size()), is_visited_by_any(boxes.size());
    float t_max = ray.t_max;
    walk_nearest_first(tree.pairs, ray, t_max, [&](std::uint32_t first, std::uint32_t count, float&) {
      for (std::uint32_t k = first; k < first + count; ++k) is_visited[tree.order[k]] = true;
    });
    walk_to_any(tree.pairs, ray, ray.t_max, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t k = first; k < first + count; ++k) is_visited_by_any[tree.order[k]] = true;
      return false;
    });
    EXPECT_EQ(is_visited, is_visited_by_any);
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      // The slabs of the box in double precision; a direction of 0 never limits, as no origin is on a face here.
      double near = 0, far = ray.t_max;
      for (int axis = 0; axis < 3; ++axis) {
        const double inverse = 1.0 / ray.direction[axis], origin = ray.origin[axis];
        const double a = (boxes[k].low[axis] - origin) * inverse, b = (boxes[k].high[axis] - origin) * inverse;
        near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
      }
      if (near <= far * (1 - 1e-5)) {
        EXPECT_TRUE(is_visited[k]);
      } else if (near > far * (1 + 1e-5)) {
        EXPECT_FALSE(is_visited[k]);
      }
    }
  }
}

}  // namespace
}  // namespace candil::test
