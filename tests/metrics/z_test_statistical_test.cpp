/// How often the z-test cries wolf, and how small a change it finds, on samples of known distributions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/metrics/noise_images.h"

namespace candil::test {
namespace {

/// Smooth: grey with the noise of a soft shadow.
double draw_smooth(std::mt19937& generator, int, int) { return std::uniform_real_distribution<>(0, 2)(generator); }

/// Rare: one path in 50 finds a bright light.
double draw_rare(std::mt19937& generator, int, int) {
  const double u = std::uniform_real_distribution<>()(generator);
  return u < 0.02 ? 40 : u;
}

/// Heavy tails: log-normal, 100 times its median once in 1000 samples.
double draw_heavy(std::mt19937& generator, int, int) { return std::lognormal_distribution<>(0, 1.5)(generator); }

/// The edge of a light: its pixels see it or not, with a chance that depends on the place.
double draw_edge(std::mt19937& generator, int x, int) {
  return std::uniform_real_distribution<>()(generator) * 32 < x ? 10 : 0.1;
}

struct Case {
  const char* name;
  DrawSample draw;
  std::uint32_t samples_a, samples_b;
};

class FalseAlarms : public testing::TestWithParam<Case> {};

// 60 pairs of images without any difference: a p-value below p is to happen with a chance of p. The smallest of 60 is
// below 1e-5 with a chance of 6e-4, which over all cases here is 1.4 %; the seeds are fixed.
TEST_P(FalseAlarms, AreAsRareAsTheySay) {
  const Case& wanted = GetParam();
  double smallest = 1;
  int below_a_tenth = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const NoisyImage a = make_noisy_image(32, 32, wanted.samples_a, 2 * i, wanted.draw);
    const NoisyImage b = make_noisy_image(32, 32, wanted.samples_b, 2 * i + 1, wanted.draw);
    const double p = test_images(a, b).p_value;
    smallest = std::min(smallest, p);
    below_a_tenth += p < 0.1 ? 1 : 0;
  }
  RecordProperty("smallest", std::to_string(smallest));
  EXPECT_GT(smallest, 1e-5);
  // 6 are expected at the most; 16 or more have a chance of 2e-4.
  EXPECT_LT(below_a_tenth, 16);
}

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const auto& [a, b] : {std::pair{2u, 2u}, {4u, 4u}, {16u, 16u}, {64u, 64u}, {8u, 128u}, {128u, 8u}}) {
    list.push_back({"smooth", draw_smooth, a, b});
    list.push_back({"rare", draw_rare, a, b});
    list.push_back({"heavy", draw_heavy, a, b});
    list.push_back({"edge", draw_edge, a, b});
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, FalseAlarms, testing::ValuesIn(cases()), [](const auto& instance) {
  return std::string(instance.param.name) + "_" + std::to_string(instance.param.samples_a) + "_" +
         std::to_string(instance.param.samples_b);
});

// 1 % more light in the middle 16 x 16 of 64 x 64 pixels at 64 samples: the samples' deviation is 0.577 of their mean,
// the square's 0.577 sqrt(2) / sqrt(64 256) = 0.0064 of it, so that one channel stands out by 1.6 deviations: hidden.
// Three channels do not help each other; 5 % are 7.8 deviations.
TEST(ZTestPower, FindsFivePercentInAPartAndOnePercentOfTheWhole) {
  const auto brighter = [](double factor, bool everywhere) {
    return [=](std::mt19937& generator, int x, int y) {
      const bool is_middle = x >= 16 && x < 32 && y >= 32 && y < 48;
      return draw_smooth(generator, x, y) * (everywhere || is_middle ? factor : 1);
    };
  };
  const NoisyImage a = make_noisy_image(64, 64, 64, 1, draw_smooth);
  EXPECT_LT(test_images(a, make_noisy_image(64, 64, 64, 2, brighter(1.05, false))).p_value, 1e-6);
  // The whole: 0.577 sqrt(2) / sqrt(64 4096) = 0.0016, 6.3 deviations.
  EXPECT_LT(test_images(a, make_noisy_image(64, 64, 64, 3, brighter(1.01, true))).p_value, 1e-6);
  EXPECT_GT(test_images(a, make_noisy_image(64, 64, 64, 4, brighter(1, true))).p_value, 1e-3);
}

}  // namespace
}  // namespace candil::test
