#include "bench/spread.h"

#include <gtest/gtest.h>

namespace candil::test {
namespace {

TEST(Spread, OfAnOddNumberHasTheMiddleValue) {
  const Spread spread = spread_of({5, 1, 9});
  EXPECT_EQ(spread.min, 1);
  EXPECT_EQ(spread.median, 5);
  EXPECT_EQ(spread.max, 9);
}

TEST(Spread, OfAnEvenNumberHasTheMeanOfTheMiddle) {
  EXPECT_EQ(spread_of({8, 1, 4, 2}).median, 3);
  EXPECT_EQ(spread_of({7}).median, 7);
}

TEST(Spread, OfNothingIsZero) {
  EXPECT_EQ(spread_of({}).median, 0);
  EXPECT_EQ(spread_of({}).max, 0);
}

// A machine that becomes ten times slower: each pair has the ratio 2, the ratio of the medians would be 2 as well, but
// not their spread.
TEST(Spread, OfRatiosComparesWhatWasMeasuredTogether) {
  const double a[] = {2, 4, 20}, b[] = {1, 2, 10};
  const Spread ratio = spread_of_ratios(a, b);
  EXPECT_EQ(ratio.min, 2);
  EXPECT_EQ(ratio.median, 2);
  EXPECT_EQ(ratio.max, 2);
}

TEST(Spread, OfRatiosLeavesDivisionsByZeroOut) {
  const double a[] = {2, 4}, b[] = {0, 1};
  EXPECT_EQ(spread_of_ratios(a, b).min, 4);
}

}  // namespace
}  // namespace candil::test
