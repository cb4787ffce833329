/// Filters and fast functions against their plain definitions.
#include "metrics/row_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrics/fast_math.h"
#include "metrics/filter_block.h"

namespace candil::test {
namespace {

std::vector<float> ramp(int count) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) values.push_back(static_cast<float>((i * 37) % 101) / 101);
  return values;
}

double plain(const HalfKernel& kernel, const std::vector<float>& values, int center) {
  double sum =
      kernel.is_symmetric ? static_cast<double>(kernel.weights[0]) * values[static_cast<std::size_t>(center)] : 0;
  for (int k = 1; k <= kernel.radius(); ++k) {
    const double right = values[static_cast<std::size_t>(center + k)],
                 left = values[static_cast<std::size_t>(center - k)];
    sum += kernel.weights[static_cast<std::size_t>(k)] * (kernel.is_symmetric ? right + left : right - left);
  }
  return sum;
}

TEST(RowFilter, IsTheSumOfItsWeightsForAnyLength) {
  HalfKernel antisymmetric = gaussian_kernel(2, 6);
  antisymmetric.is_symmetric = false;
  for (const HalfKernel& kernel : {gaussian_kernel(1.5, 5), antisymmetric}) {
    const int radius = kernel.radius();
    for (const int count : {1, 7, 31, 32, 33, 64, 100}) {
      const std::vector<float> values = ramp(count + 2 * radius);
      std::vector<float> along(static_cast<std::size_t>(count));
      filter_along_row(kernel, values.data() + radius, along.data(), count);
      for (int i = 0; i < count; ++i)
        ASSERT_NEAR(along[static_cast<std::size_t>(i)], plain(kernel, values, i + radius), 1e-6) << count << ' ' << i;

      // Rows that are one pixel further each: across them is the same as along.
      std::vector<const float*> rows;
      for (int k = 0; k <= 2 * radius; ++k) rows.push_back(values.data() + k);
      std::vector<float> across(static_cast<std::size_t>(count));
      filter_across_rows(kernel, rows, across.data(), count);
      ASSERT_EQ(across, along);
    }
  }
}

TEST(RowFilter, SeveralTogetherAreTheSameAsOneByOne) {
  HalfKernel antisymmetric = gaussian_kernel(2, 6);
  antisymmetric.is_symmetric = false;
  const HalfKernel wide = gaussian_kernel(3, 6), narrow = gaussian_kernel(1, 6);
  const HalfKernel* const kernels[] = {&wide, &antisymmetric, &narrow};
  for (const int count : {5, 40, 129}) {
    const std::vector<float> values = ramp(count + 12);
    const auto size = static_cast<std::size_t>(count);
    std::vector<std::vector<float>> alone(3, std::vector<float>(size)), together = alone;
    Filters<3> filters = {{}, {}, {6, 6, 6}};
    for (std::size_t i = 0; i < 3; ++i) {
      filter_along_row(*kernels[i], values.data() + 6, alone[i].data(), count);
      filters.weights[i] = kernels[i]->weights.data(), filters.out[i] = together[i].data();
    }
    filter_along<true, false, true>(filters, values.data() + 6, count);
    EXPECT_EQ(together, alone) << count;

    std::vector<const float*> rows;
    for (int k = 0; k <= 12; ++k) rows.push_back(values.data() + k);
    for (std::vector<float>& row : together) std::ranges::fill(row, -1.0f);
    filter_across<true, false, true>(filters, rows.data() + 6, count);
    EXPECT_EQ(together, alone) << count;

    // Added to what is there: twice the sum, up to its rounding.
    filters.adds = true;
    filter_along<true, false, true>(filters, values.data() + 6, count);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t x = 0; x < size; ++x) ASSERT_NEAR(together[i][x], 2 * alone[i][x], 1e-6) << i << ' ' << x;
  }
}

TEST(RowFilter, GivesTheSameBitsWhereverAPixelLies) {
  const HalfKernel kernel = gaussian_kernel(3, 9);
  const std::vector<float> values = ramp(200);
  std::vector<float> whole(150), part(11);
  filter_along_row(kernel, values.data() + 9, whole.data(), 150);
  filter_along_row(kernel, values.data() + 9 + 40, part.data(), 11);
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], whole[i + 40]);
}

TEST(RowFilter, GaussianKernelHasTheRatiosOfAGaussian) {
  const HalfKernel kernel = gaussian_kernel(1.5, 5);
  double sum = kernel.weights[0];
  for (int k = 1; k <= 5; ++k) {
    EXPECT_NEAR(kernel.weights[static_cast<std::size_t>(k)] / kernel.weights[0], std::exp(-k * k / 4.5), 1e-7);
    sum += 2 * kernel.weights[static_cast<std::size_t>(k)];
  }
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(FastMath, IsAsExactAsItSays) {
  for (double x = 1e-12; x < 1e9; x *= 1.0137) {
    const auto value = static_cast<float>(x);
    ASSERT_NEAR(fast_cbrt(value) / std::cbrt(static_cast<double>(value)), 1, 5e-7) << x;
    ASSERT_NEAR(fast_sqrt(value) / std::sqrt(static_cast<double>(value)), 1, 3e-7) << x;
    if (x > 0.25 && x < 4) {
      ASSERT_NEAR(fast_log2(value), std::log2(static_cast<double>(value)), 2e-7) << x;
    }
    for (const float power : {0.5f, 0.7f, 2.4f})
      ASSERT_NEAR(fast_pow(value, power) / std::pow(static_cast<double>(value), static_cast<double>(power)), 1,
                  x > 1e-6 && x < 1e3 ? 3e-6 : 1e-5)
          << x << '^' << power;
  }
  for (double x = -125; x < 126; x += 0.37)
    ASSERT_NEAR(fast_exp2(static_cast<float>(x)) / std::exp2(static_cast<double>(static_cast<float>(x))), 1, 3e-7) << x;
  EXPECT_EQ(fast_sqrt(0), 0);
  EXPECT_EQ(fast_cbrt(0), 0);
  EXPECT_EQ(fast_pow(0, 0.7f), 0);
  EXPECT_EQ(fast_pow(1, 2.4f), 1);
}

// Kernels that reach less far than the first one, each alone and together.
TEST(RowFilter, RadiiMayDiffer) {
  HalfKernel antisymmetric = gaussian_kernel(2, 6);
  antisymmetric.is_symmetric = false;
  const HalfKernel near = gaussian_kernel(1, 3), nearest = gaussian_kernel(1, 1);
  const HalfKernel* const kernels[] = {&antisymmetric, &near, &nearest};
  constexpr std::size_t count = 77;
  const std::vector<float> values = ramp(static_cast<int>(count) + 12);
  std::vector<std::vector<float>> alone(3, std::vector<float>(count)), together = alone;
  Filters<3> filters = {};
  for (std::size_t i = 0; i < 3; ++i) {
    filter_along_row(*kernels[i], values.data() + 6, alone[i].data(), static_cast<int>(count));
    filters.weights[i] = kernels[i]->weights.data(), filters.out[i] = together[i].data();
    filters.radii[i] = kernels[i]->radius();
  }
  filter_along<false, true, true>(filters, values.data() + 6, static_cast<int>(count));
  EXPECT_EQ(together, alone);
}

// Four rows at once beside one at a time: the same sums in another order. Rows are shifted ramps.
TEST(RowFilter, RowsOfABatchAreThoseOfOneAtATime) {
  constexpr int batch = 4, columns = filter_lanes;
  for (const int radius : {1, 2, 9}) {
    HalfKernel antisymmetric = gaussian_kernel(2, radius);
    antisymmetric.is_symmetric = false;
    const HalfKernel symmetric = gaussian_kernel(3, radius);
    const std::vector<float> wholes[] = {whole_kernel(symmetric), whole_kernel(antisymmetric)};
    const int height = 2 * radius + batch;
    const std::vector<float> values = ramp(height * 7 + columns);
    std::vector<const float*> rows;
    for (int j = 0; j < height; ++j) rows.push_back(values.data() + j * 7);
    BatchSums<batch, 1, 2> sums;
    sums.add({wholes[0].data(), wholes[1].data()}, radius, rows.data(), 0);
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<float> out(std::size_t{batch} * columns), wanted(columns);
      sums.store(i, out.data(), columns, 0);
      for (int r = 0; r < batch; ++r) {
        filter_across_rows(
            i == 0 ? symmetric : antisymmetric,
            std::span(rows).subspan(static_cast<std::size_t>(r), 2 * static_cast<std::size_t>(radius) + 1),
            wanted.data(), columns);
        for (int x = 0; x < columns; ++x)
          EXPECT_NEAR(out[static_cast<std::size_t>(r * columns + x)], wanted[static_cast<std::size_t>(x)], 2e-6)
              << radius << ' ' << i << ' ' << r << ' ' << x;
      }
    }
  }
}

}  // namespace
}  // namespace candil::test
