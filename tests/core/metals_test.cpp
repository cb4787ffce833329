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

// Between neighbours of the published table: Johnson and Christy 1972 give gold 0.21 - 3.272 i at 616.8 nm and 0.14 -
// 3.697 i at 659.5 nm.
TEST(Metals, GoldInRedIsThatOfJohnsonAndChristy) {
  const Metal gold = *find_metal("gold");
  const float fraction = (630 - 616.8f) / (659.5f - 616.8f);
  EXPECT_NEAR(gold.eta.x, 0.21f + fraction * (0.14f - 0.21f), 5e-4f);
  EXPECT_NEAR(gold.k.x, 3.272f + fraction * (3.697f - 3.272f), 5e-4f);
}

}  // namespace
}  // namespace candil::test
