#include "io/animation_curve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace candil {
namespace {

const std::vector<float> times = {1, 3};

std::vector<double> at(double seconds, const std::vector<float>& values, Interpolation interpolation,
                       std::size_t components, bool is_rotation = false) {
  return evaluate({interpolation, is_rotation, components, times, values}, seconds);
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-7) << i;
}

TEST(AnimationCurve, StepsKeepTheValueUntilTheNextKey) {
  const std::vector<float> values = {1, 2, 30, 40};
  expect_near(at(1, values, Interpolation::step, 2), {1, 2});
  expect_near(at(2.999, values, Interpolation::step, 2), {1, 2});
  expect_near(at(3, values, Interpolation::step, 2), {30, 40});
}

// A quarter of the way from t = 1 to t = 3.
TEST(AnimationCurve, LinesMixTheNeighbours) { expect_near(at(1.5, {0, 8, 10, 0}, Interpolation::linear, 2), {2.5, 6}); }

TEST(AnimationCurve, StandsStillBeyondItsEnds) {
  for (const Interpolation interpolation : {Interpolation::step, Interpolation::linear}) {
    expect_near(at(-7, {4, 5}, interpolation, 1), {4});
    expect_near(at(1e9, {4, 5}, interpolation, 1), {5});
  }
  const std::vector<float> spline = {9, 4, 9, 9, 5, 9};  // tangents, which must not show
  expect_near(at(0, spline, Interpolation::cubic_spline, 1), {4});
  expect_near(at(1, spline, Interpolation::cubic_spline, 1), {4});
  expect_near(at(3, spline, Interpolation::cubic_spline, 1), {5});
  expect_near(at(4, spline, Interpolation::cubic_spline, 1), {5});
}

TEST(AnimationCurve, OneKeyIsAConstant) {
  const std::vector<float> time = {2}, value = {7};
  for (const double seconds : {0.0, 2.0, 5.0}) {
    expect_near(evaluate({Interpolation::linear, false, 1, time, value}, seconds), {7});
  }
}

// Half-way between no turn and a quarter turn about Z lies an eighth: (0, 0, sin 22.5, cos 22.5). A quaternion and its
// negative are the same turn; the way between them is the short one.
TEST(AnimationCurve, RotationsTakeTheShortArc) {
  const auto h = static_cast<float>(std::sqrt(0.5));
  const double angle = std::acos(-1) / 8;
  const std::vector<double> expected = {0, 0, std::sin(angle), std::cos(angle)};
  expect_near(at(2, {0, 0, 0, 1, 0, 0, h, h}, Interpolation::linear, 4, true), expected);
  expect_near(at(2, {0, 0, 0, 1, 0, 0, -h, -h}, Interpolation::linear, 4, true), expected);
  // A third of the way is a third of the angle, which mixing the components would miss by 1e-3.
  const double third = std::acos(-1) / 12;
  expect_near(at(1 + 2.0 / 3, {0, 0, 0, 1, 0, 0, h, h}, Interpolation::linear, 4, true),
              {0, 0, std::sin(third), std::cos(third)});
}

TEST(AnimationCurve, EqualRotationsAndOppositeOnesStayFinite) {
  expect_near(at(2, {0, 0, 0, 1, 0, 0, 0, 1}, Interpolation::linear, 4, true), {0, 0, 0, 1});
  expect_near(at(2, {0, 0, 0, 1, 0, 0, 0, -1}, Interpolation::linear, 4, true), {0, 0, 0, 1});
  for (const double value : at(2, {0, 0, 0, 0, 0, 0, 0, 0}, Interpolation::linear, 4, true)) EXPECT_EQ(value, 0);
}

// Appendix C.5 at the middle, t = 1/2, of a segment of 2 s: 1/2 v + 2 (1/8) b + 1/2 w + 2 (-1/8) a.
// With v = 1, b = 2, w = 5, a = -1: 0.5 + 0.5 + 2.5 + 0.25 = 3.75.
TEST(AnimationCurve, SplinesScaleTheirTangentsByTheInterval) {
  expect_near(at(2, {99, 1, 2, -1, 5, 99}, Interpolation::cubic_spline, 1), {3.75});
}

// Three of everything: a key holds its three in-tangents, then its values, then its out-tangents. Tangents of 1 and
// values on the line t make that line.
TEST(AnimationCurve, SplinesGroupTangentsByKey) {
  const std::vector<float> line = {1, 1, 1, 1, 2, 3, 1, 1, 1, 1, 1, 1, 3, 4, 5, 1, 1, 1};
  expect_near(at(1.5, line, Interpolation::cubic_spline, 3), {1.5, 2.5, 3.5});
}

// Between no turn and a quarter turn about Z with no tangents, at the middle: (0, 0, h / 2, 1/2 + h / 2), normalised;
// its direction is that of half the angle.
TEST(AnimationCurve, SplinesOfRotationsAreNormalised) {
  const auto h = static_cast<float>(std::sqrt(0.5));
  const std::vector<float> keys = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, h, h, 0, 0, 0, 0};
  const double angle = std::acos(-1) / 8;
  expect_near(at(2, keys, Interpolation::cubic_spline, 4, true), {0, 0, std::sin(angle), std::cos(angle)});
}

}  // namespace
}  // namespace candil
