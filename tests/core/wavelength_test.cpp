#include "core/wavelength.h"

#include <gtest/gtest.h>

#include <cmath>

namespace candil {
namespace {

constexpr int count = 1 << 18;

Wavelength at(int i) { return sample_wavelength((static_cast<float>(i) + 0.5f) / count); }

// All wavelengths together are white, none is worth less than nothing, and no channel varies by more than is said.
TEST(Wavelength, ResponseIsWhiteOnTheWhole) {
  glm::dvec3 sum(0), variation(0);
  Vec3 previous = sample_wavelength(0).response;
  for (int i = 0; i < count; ++i) {
    const Vec3 response = at(i).response;
    ASSERT_GE(min_component(response), 0);
    ASSERT_NEAR(response.x + response.y + response.z, 3, 0.01f);
    sum += response;
    variation += glm::abs(glm::dvec3(response - previous));
    previous = response;
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c] / count, 1, 1e-6);
    EXPECT_LT(variation[c], 7);
  }
}

// Mean wavelengths of the channels: where a display's primaries are, about (Rec.709's have dominant wavelengths of 611,
// 549 and 464 nm; violet has some red).
TEST(Wavelength, ChannelsAreInTheOrderOfTheSpectrum) {
  glm::dvec3 mean(0);
  float previous = 0;
  for (int i = 0; i < count; ++i) {
    const Wavelength w = at(i);
    ASSERT_GE(w.nanometres, previous);
    previous = w.nanometres;
    mean += glm::dvec3(w.response) * static_cast<double>(w.nanometres) / static_cast<double>(count);
  }
  EXPECT_NEAR(mean.x, 605, 15);
  EXPECT_NEAR(mean.y, 545, 15);
  EXPECT_NEAR(mean.z, 455, 15);
  EXPECT_NEAR(sample_wavelength(0).nanometres, 400, 1);
  EXPECT_NEAR(previous, 680, 1);
}

// The text's Fraunhofer lines: n_d is the index itself, and n_F - n_C = (n_d - 1) / V_d. For n_d = 1.5 and V_d = 20
// that is 0.025. The text rounds its constants to six digits.
TEST(Wavelength, IndexFollowsTheAbbeNumber) {
  EXPECT_NEAR(dispersed_ior(1.5f, 1, 587.56f), 1.5f, 2e-6f);
  EXPECT_NEAR(dispersed_ior(1.5f, 1, 486.13f) - dispersed_ior(1.5f, 1, 656.27f), 0.025f, 1e-5f);
  EXPECT_NEAR(dispersed_ior(2.42f, 20 / 55.0f, 486.13f) - dispersed_ior(2.42f, 20 / 55.0f, 656.27f), 1.42f / 55, 1e-5f);
  EXPECT_EQ(dispersed_ior(1.5f, 100, 680), 1) << "never below";
  EXPECT_EQ(dispersed_ior(1, 1, 400), 1);
}

}  // namespace
}  // namespace candil
