/// What every operator owes: finite values in [0, 1] for whatever comes, and brighter for brighter light.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/tonemap.h"
#include "tests/core/tonemap_samples.h"

namespace candil {
namespace {

using test::display_values;
using test::row_of;
using test::row_of_greys;

class EveryTonemap : public testing::TestWithParam<std::string> {
 protected:
  Tonemap tonemap() const { return make_tonemap(*tonemap_from_name(GetParam())); }
};

void expect_displayable(const std::vector<Vec3>& values) {
  for (const Vec3 value : values)
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(value[i] >= 0 && value[i] <= 1) << value[i];
}

// Ten greys per decade from 1e-6 to 1e7, after black.
TEST_P(EveryTonemap, RisesOverThirteenDecades) {
  std::vector<float> greys = {0};
  for (int i = -60; i <= 70; ++i) greys.push_back(static_cast<float>(std::pow(10.0, i / 10.0)));
  const std::vector<Vec3> values = display_values(row_of_greys(greys), tonemap());
  expect_displayable(values);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_GE(values[i].y, values[i - 1].y - 1e-7f) << greys[i];
  EXPECT_EQ(values.front(), Vec3(0));
  EXPECT_GT(values.back().y, 0.99f);
}

TEST_P(EveryTonemap, LeavesBlackImagesBlack) {
  for (const Vec3 value : display_values(row_of_greys({0, 0, 0}), tonemap())) EXPECT_EQ(value, Vec3(0));
  EXPECT_TRUE(to_display(Image(), 0, tonemap()).pixels.empty());
}

TEST_P(EveryTonemap, SurvivesImagesOfOneColor) {
  for (const float grey : {1e-30f, 1e-3f, 1.0f, 1e7f, 3e38f})
    expect_displayable(display_values(row_of_greys({grey, grey}), tonemap()));
}

// Every parameter at both ends of its range, with everything that a float can be, at both ends of the exposure.
TEST_P(EveryTonemap, SurvivesAnything) {
  constexpr float largest = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  const Image image = row_of({{std::nanf(""), 1, 1},
                              {infinity, infinity, infinity},
                              {-infinity, 0, 1},
                              {-1, -2, -3},
                              {largest, 0, 0},
                              {0, largest, largest},
                              {least, least, 0},
                              {1e7f, 1e-7f, 0}});
  std::vector<Tonemap> variants = {tonemap()};
  for (const TonemapParameter& parameter : tonemap_parameters(tonemap().kind))
    for (const double end : {parameter.low, parameter.high}) {
      Tonemap variant = tonemap();
      variant.*parameter.field = end;
      variants.push_back(variant);
    }
  for (const Tonemap& variant : variants)
    for (const float exposure : {-64.0f, 0.0f, 64.0f}) expect_displayable(display_values(image, variant, exposure));
}

// The same with alpha, down to the least that there is.
TEST_P(EveryTonemap, SurvivesAnyAlpha) {
  Image image(4, 1, 4);
  image.pixels = {1, 2, 3, 0, 1, 2, 3, std::numeric_limits<float>::denorm_min(), 3e38f, 0, 0, 1e-30f, 1, 1, 1, 1};
  expect_displayable(display_values(image, tonemap()));
}

// A dot of ten million in a dim room must not spoil the arithmetic (whether the room can be seen is the operator's).
TEST_P(EveryTonemap, SurvivesALampInTheDark) {
  std::vector<float> greys(1000, 0.01f);
  greys[500] = 1e7f;
  const std::vector<Vec3> values = display_values(row_of_greys(greys), tonemap());
  expect_displayable(values);
  EXPECT_GT(values[500].x, values[0].x);
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Tonemap, EveryTonemap, testing::ValuesIn(tonemap_names()), test_name);

}  // namespace
}  // namespace candil
