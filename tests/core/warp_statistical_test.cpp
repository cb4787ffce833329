/// Each warp against its density.
#include "core/warp.h"

#include <gtest/gtest.h>

#include "tests/support/chi_square.h"

namespace candil {
namespace {

constexpr int count = 200'000;

TEST(WarpStatistics, Disc) {
  // Rings of equal area times sectors of equal angle: all cells are equally likely.
  constexpr int rings = 20, sectors = 40;
  std::vector<double> observed(rings * sectors),
      expected(rings * sectors, static_cast<double>(count) / (rings * sectors));
  test::Random random(2);
  for (int i = 0; i < count; ++i) {
    const Vec2 p = sample_disc(random.next_2d());
    const float area = glm::dot(p, p), turn = std::atan2(p.y, p.x) / (2 * pi) + 0.5f;
    ASSERT_LE(area, 1 + 1e-6f);
    ++observed[glm::min(static_cast<int>(area * rings), rings - 1) * sectors +
               glm::min(static_cast<int>(turn * sectors), sectors - 1)];
  }
  EXPECT_GT(test::chi_square_test(observed, expected).p_value, test::significance);
}

TEST(WarpStatistics, Triangle) {
  // Cells of the grid over both weights; those on the diagonal are cut in half by it.
  constexpr int n = 24;
  std::vector<double> observed(n * n), expected(n * n);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x + y < n; ++x) expected[y * n + x] = (x + y == n - 1 ? 1.0 : 2.0) * count / (n * n);
  }
  test::Random random(3);
  for (int i = 0; i < count; ++i) {
    const Vec2 b = sample_triangle(random.next_2d());
    ASSERT_GE(glm::min(b.x, b.y), 0.0f);
    ASSERT_LE(b.x + b.y, 1.0f);
    ++observed[static_cast<int>(b.y * n) * n + static_cast<int>(b.x * n)];
  }
  EXPECT_GT(test::chi_square_test(observed, expected).p_value, test::significance);
}

TEST(WarpStatistics, CosineHemisphere) {
  const auto result = test::test_directions(
      [](test::Random& random) { return std::optional(sample_cosine_hemisphere(random.next_2d())); },
      [](Vec3 d) { return pdf_cosine_hemisphere(d.z); }, count);
  EXPECT_GT(result.p_value, test::significance) << result.statistic << " / " << result.degrees_of_freedom;
}

TEST(WarpStatistics, Sphere) {
  const auto result =
      test::test_directions([](test::Random& random) { return std::optional(sample_sphere(random.next_2d())); },
                            [](Vec3) { return pdf_sphere; }, count);
  EXPECT_GT(result.p_value, test::significance) << result.statistic << " / " << result.degrees_of_freedom;
}

TEST(WarpStatistics, CornersOfTheSquareStayInTheDomain) {
  for (const float x : {0.0f, 0.5f, one_minus_epsilon}) {
    for (const float y : {0.0f, 0.5f, one_minus_epsilon}) {
      EXPECT_LE(glm::length(sample_disc({x, y})), 1 + 1e-6f);
      EXPECT_GE(sample_cosine_hemisphere({x, y}).z, 0.0f);
      EXPECT_NEAR(glm::length(sample_cosine_hemisphere({x, y})), 1, 1e-6f);
      EXPECT_NEAR(glm::length(sample_sphere({x, y})), 1, 1e-6f);
      const Vec2 b = sample_triangle({x, y});
      EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1) << b.x << ", " << b.y;
    }
  }
}

}  // namespace
}  // namespace candil
