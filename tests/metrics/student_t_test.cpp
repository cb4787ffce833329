/// Tails of Student's distribution where they have closed forms.
#include "metrics/student_t.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace candil::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// P(|T| >= t): 1 degree 1 - 2 atan(t) / pi = 2 atan(1 / t) / pi; 2 degrees 1 - t / sqrt(2 + t^2), which is
// 2 / ((2 + t^2) (1 + t / sqrt(2 + t^2))) without cancellation.
TEST(StudentT, OneAndTwoDegreesOfFreedom) {
  for (const double t : {0.1, 1.0, 3.0, 10.0, 1e3, 1e6}) {
    EXPECT_NEAR(log10_student_tails(t, 1), std::log10(2 * std::atan(1 / t) / std::numbers::pi), 1e-9) << t;
    const double root = std::sqrt(2 + t * t);
    EXPECT_NEAR(log10_student_tails(t, 2), std::log10(2 / (root * root * (1 + t / root))), 1e-9) << t;
  }
}

// 4 degrees: with c = t / sqrt(4 + t^2), P(|T| < t) = c (1 + (1 - c^2) / 2).
TEST(StudentT, FourDegreesOfFreedom) {
  for (const double t : {0.5, 2.0, 5.0, 20.0}) {
    const double c = t / std::sqrt(4 + t * t);
    EXPECT_NEAR(std::pow(10, log10_student_tails(t, 4)), 1 - c * (1 + (1 - c * c) / 2), 1e-9) << t;
  }
}

TEST(StudentT, NormalTails) {
  EXPECT_NEAR(std::pow(10, log10_normal_tails(1.959964)), 0.05, 1e-7);
  EXPECT_NEAR(log10_normal_tails(5), std::log10(5.733031e-7), 1e-5);
  // At 30 the one formula takes over from the other.
  EXPECT_NEAR(log10_normal_tails(30 - 1e-9), log10_normal_tails(30 + 1e-9), 1e-5);
  EXPECT_EQ(log10_student_tails(5, infinite), log10_normal_tails(5));
  EXPECT_EQ(log10_student_tails(infinite, 3), -1000);
  EXPECT_EQ(log10_student_tails(0, 7), 0);
}

// At 30 degrees of freedom an approximation takes over: 1 % of the probability is 0.0043.
TEST(StudentT, ApproximationAgreesWithTheExactForm) {
  for (const double t : {3.3, 5.0, 8.0, 12.0})
    EXPECT_NEAR(log10_student_tails(t, 30 - 1e-9), log10_student_tails(t, 30 + 1e-9), 0.0043) << t;
}

TEST(StudentT, FallsWithTheDistanceAndTheDegreesOfFreedom) {
  for (const double freedom : {1.0, 3.5, 29.0, 31.0, 1e3, 1e7}) {
    double before = 1;
    for (double t = 0; t < 200; t += 0.25) {
      const double now = log10_student_tails(t, freedom);
      EXPECT_LE(now, before) << t << ' ' << freedom;
      before = now;
    }
  }
  EXPECT_GT(log10_student_tails(6, 3), log10_student_tails(6, 10));
  EXPECT_GT(log10_student_tails(6, 10), log10_student_tails(6, 100));
  EXPECT_GT(log10_student_tails(6, 100), log10_student_tails(6, infinite));
}

}  // namespace
}  // namespace candil::test
