#include "core/metals.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace candil::test {
namespace {

TEST(Metals, AreFoundByNameAndSymbol) {
  for (const Metal& metal : metals()) {
    EXPECT_EQ(find_metal(metal.name)->symbol, metal.symbol);
    EXPECT_EQ(find_metal(metal.symbol)->name, metal.name);
    EXPECT_GT(min_component(metal.eta), 0) << metal.name;
    EXPECT_GT(min_component(metal.k), 1) << metal.name;
  }
  EXPECT_TRUE(
      std::is_sorted(metals().begin(), metals().end(), [](const Metal& a, const Metal& b) { return a.name < b.name; }));
  for (const char* text : {"", "Gold", "AU", "gold ", "brass"}) EXPECT_FALSE(find_metal(text)) << text;
}

/// A line of a published table.
struct Published {
  float nanometres, eta, k;
};

struct Neighbours {
  const char* metal;
  int channel;
  Published below, above;
};

// The neighbours of the wavelength in the published tables, of every source one metal at least: Johnson and Christy
// 1972 (gold, copper, silver) and 1974 (iron), Rakic 1995 (aluminium), Rakic et al. 1998 (tungsten).
const Neighbours published[] = {
    {"gold", 0, {616.8f, 0.21f, 3.272f}, {659.5f, 0.14f, 3.697f}},
    {"gold", 2, {450.9f, 1.38f, 1.914f}, {471.4f, 1.31f, 1.849f}},
    {"copper", 0, {616.8f, 0.30f, 3.205f}, {659.5f, 0.22f, 3.747f}},
    {"silver", 0, {616.8f, 0.06f, 4.152f}, {659.5f, 0.05f, 4.483f}},
    {"iron", 0, {616.8f, 2.88f, 3.05f}, {659.5f, 2.92f, 3.10f}},
    {"aluminium", 1, {516.6f, 0.8734f, 6.2418f}, {563.57f, 1.0728f, 6.7839f}},
    {"tungsten", 0, {624.68f, 3.6301f, 2.7956f}, {637.09f, 3.6423f, 2.7960f}},
};

TEST(Metals, AreBetweenTheNeighboursOfPublishedTables) {
  for (const auto& [name, channel, below, above] : published) {
    const Metal metal = *find_metal(name);
    const float wavelength = Vec3(630, 532, 465)[channel];
    const float fraction = (wavelength - below.nanometres) / (above.nanometres - below.nanometres);
    EXPECT_NEAR(metal.eta[channel], glm::mix(below.eta, above.eta, fraction), 1e-3f) << name << channel;
    EXPECT_NEAR(metal.k[channel], glm::mix(below.k, above.k, fraction), 1e-3f) << name << channel;
  }
}

}  // namespace
}  // namespace candil::test
