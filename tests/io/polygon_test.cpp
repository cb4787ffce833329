/// What polygons may cost.
#include "io/polygon.h"

#include <gtest/gtest.h>

#include <cmath>

namespace candil::test {
namespace {

/// A star whose points are deep: every other corner is concave.
std::vector<Vec3> star(int corners) {
  std::vector<Vec3> outline;
  for (int i = 0; i < corners; ++i) {
    const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(corners), radius = i % 2 == 0 ? 1 : 0.5f;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return outline;
}

TEST(Polygon, TestsGoOffTheBudget) {
  std::vector<Triangle> triangles;
  std::size_t left = 1'000'000;
  EXPECT_TRUE(triangulate_polygon(star(100), triangles, left));
  EXPECT_EQ(triangles.size(), 98U);
  EXPECT_LT(left, 1'000'000U - 100U);  // 50 ears at the points, tested against at least 50 corners each
  EXPECT_GT(left, 900'000U);           // less than 1000 for each corner
}

TEST(Polygon, WithoutBudgetConcaveOnesAreFans) {
  std::vector<Triangle> triangles;
  std::size_t left = 60;  // not enough for one ear
  EXPECT_FALSE(triangulate_polygon(star(100), triangles, left));
  EXPECT_EQ(triangles.size(), 98U);
  EXPECT_EQ(left, 0U);
  EXPECT_TRUE(triangulate_polygon(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, triangles, left));
}

}  // namespace
}  // namespace candil::test
