// Moving subtrees: trees stay trees, and cost less.
#include "core/bvh/reinsertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace candil {
namespace {

constexpr TreeSettings settings{.unsplit_size = 1};

std::vector<PrimitiveRef> random_refs(std::size_t count, float longest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<PrimitiveRef> refs;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = unit(random), y = unit(random), z = unit(random);
    Vec3 size(0.005f);
    size[static_cast<int>(i % 3)] = longest * unit(random);
    refs.emplace_back(FlippedBox(Bounds{Vec3(x, y, z), Vec3(x, y, z) + size}), static_cast<std::uint32_t>(i));
  }
  return refs;
}

struct Costs {
  float before = 0, after = 0;
};

/// Both trees are checked by walking through them.
class Checked {
 public:
  explicit Checked(std::vector<PrimitiveRef> refs)
      : refs_(std::move(refs)), scratch_(refs_.size()), nodes_(refs_.size()) {
    build_binary_tree(nodes_, refs_, scratch_, settings);
    costs.before = nodes_[0].cost[0];
    walk();
    reinsert_subtrees(nodes_, refs_, scratch_, settings);
    costs.after = nodes_[0].cost[0];
    walk();
  }
  Costs costs;

 private:
  void walk() {
    std::vector<bool> is_met(refs_.size());
    EXPECT_EQ(nodes_[0].first(), 0U);
    EXPECT_EQ(nodes_[0].count(), refs_.size());
    visit(nodes_[0], 0);
    for (const PrimitiveRef& ref : refs_) is_met[ref.id()] = true;
    EXPECT_EQ(std::count(is_met.begin(), is_met.end(), true), static_cast<std::ptrdiff_t>(refs_.size()));
  }
  void visit(const BinaryNode& node, int depth) {
    ASSERT_LE(depth, max_binary_depth);
    FlippedBox box;
    for (std::uint32_t i = node.first(); i < node.first() + node.count(); ++i) box.add(refs_[i].box());
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(box.low(axis), node.box().low(axis));
      ASSERT_EQ(box.high(axis), node.box().high(axis));
    }
    if (node.is_leaf()) {
      ASSERT_LE(node.count(), settings.max_leaf_size);
      return;
    }
    const BinaryNode &left = nodes_[node.left], &right = nodes_[node.left + 1];
    ASSERT_EQ(left.first(), node.first());
    ASSERT_EQ(right.first(), left.first() + left.count());
    ASSERT_EQ(left.count() + right.count(), node.count());
    visit(left, depth + 1), visit(right, depth + 1);
  }

  std::vector<PrimitiveRef> refs_, scratch_;
  BinaryNodes nodes_;
};

TEST(Reinsertion, KeepsTreesWhole) {
  for (const std::size_t count : {1U, 2U, 3U, 5U, 8U, 17U, 100U, 1000U, 20000U}) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(count);
      const Checked checked(random_refs(count, 0.5f, seed));
      EXPECT_LE(checked.costs.after, checked.costs.before);
    }
  }
}

TEST(Reinsertion, PaysForLongBoxes) {
  const Checked checked(random_refs(20000, 0.5f, 1));
  EXPECT_LT(checked.costs.after, 0.97f * checked.costs.before);
}

TEST(Reinsertion, TakesManyOfTheSame) {
  std::vector<PrimitiveRef> refs;
  for (std::uint32_t i = 0; i < 5000; ++i) refs.emplace_back(FlippedBox(Bounds{Vec3(1), Vec3(2)}), i);
  const Checked checked(std::move(refs));
  EXPECT_LE(checked.costs.after, checked.costs.before);
}

// As deep as trees get, see the test of the same name of build_wide_tree().
TEST(Reinsertion, KeepsTheBoundOfTheDepth) {
  std::vector<PrimitiveRef> refs;
  for (int i = 0; i < 400; ++i) {
    const float size = 1e18f * std::pow(0.8f, static_cast<float>(i));
    for (int copy = 0; copy < 5; ++copy) {
      refs.emplace_back(FlippedBox(Bounds{Vec3(size), Vec3(1.1f * size)}), static_cast<std::uint32_t>(refs.size()));
    }
  }
  const Checked checked(std::move(refs));
  EXPECT_LE(checked.costs.after, checked.costs.before);
}

}  // namespace
}  // namespace candil
