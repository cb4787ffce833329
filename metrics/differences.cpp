#include "metrics/differences.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/parallel_rows.h"

namespace candil {
namespace {

struct RowSums {
  std::size_t different_pixels = 0, non_finite_pixels = 0;
  double absolute = 0, squared = 0, relative = 0;
  float largest = 0, peak = 0;
  int largest_x = 0, largest_channel = 0, largest_y = 0;
  std::vector<double> signed_sums;  // of each channel

  RowSums& operator+=(const RowSums& other) {
    different_pixels += other.different_pixels, non_finite_pixels += other.non_finite_pixels;
    absolute += other.absolute, squared += other.squared, relative += other.relative;
    peak = std::max(peak, other.peak);
    if (other.largest > largest) {
      largest = other.largest;
      largest_x = other.largest_x, largest_y = other.largest_y, largest_channel = other.largest_channel;
    }
    signed_sums.resize(other.signed_sums.size());
    for (std::size_t c = 0; c < signed_sums.size(); ++c) signed_sums[c] += other.signed_sums[c];
    return *this;
  }
};

RowSums measure_row(const ImagePair& pair, const PixelSelection& selection, int y, float* error) {
  const int channels = pair.a.channels;
  const float* a = pair.a.pixel(0, y);
  const float* b = pair.b.pixel(0, y);
  RowSums sums;
  sums.signed_sums.resize(static_cast<std::size_t>(channels));
  for (int x = 0; x < pair.width(); ++x, a += channels, b += channels) {
    float largest = 0;
    int largest_channel = 0;
    for (int c = 0; c < channels; ++c) {
      const float size = std::abs(difference(a[c], b[c]));
      if (size > largest) largest = size, largest_channel = c;
    }
    error[x] = largest;
    if (!selection.contains(x, y)) continue;
    for (int c = 0; c < channels; ++c)
      if (std::isfinite(a[c])) sums.peak = std::max(sums.peak, std::abs(a[c]));
    if (largest == 0) continue;
    ++sums.different_pixels;
    if (largest == infinity) ++sums.non_finite_pixels;
    if (largest > sums.largest)
      sums.largest = largest, sums.largest_x = x, sums.largest_y = y, sums.largest_channel = largest_channel;
    for (int c = 0; c < channels; ++c) {
      const double delta = difference(a[c], b[c]), square = delta * delta;
      const double wanted = std::isfinite(a[c]) ? a[c] : 0;
      sums.signed_sums[static_cast<std::size_t>(c)] += delta;
      sums.absolute += std::abs(delta);
      sums.squared += square;
      sums.relative += square / (wanted * wanted + relative_floor);
    }
  }
  return sums;
}

}  // namespace

double Differences::root_mean_squared() const { return std::sqrt(mean_squared); }

double Differences::peak_signal_to_noise() const {
  if (mean_squared == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(peak * peak / mean_squared);
}

double Differences::largest_bias() const {
  double farthest = 0;
  for (const double value : bias)
    if (!(std::abs(value) <= std::abs(farthest))) farthest = value;
  return farthest;
}

Differences measure_differences(const ImagePair& pair, const PixelSelection& selection) {
  Differences result;
  result.error = Image(pair.width(), pair.height(), 1);
  const auto sums = sum_rows<RowSums>(pair.height(),
                                      [&](int y) { return measure_row(pair, selection, y, result.error.pixel(0, y)); });
  result.pixels = selection.count();
  result.different_pixels = sums.different_pixels, result.non_finite_pixels = sums.non_finite_pixels;
  result.largest = sums.largest;
  result.largest_x = sums.largest_x, result.largest_y = sums.largest_y;
  result.largest_channel = sums.largest_channel;
  if (pair.kind != ValueKind::display) result.peak = sums.peak;
  const auto channels = static_cast<std::size_t>(pair.a.channels);
  const double pixels = std::max(1.0, static_cast<double>(result.pixels));
  for (std::size_t c = 0; c < channels; ++c) result.bias.push_back(sums.signed_sums[c] / pixels);
  const double values = pixels * static_cast<double>(channels);
  result.mean_absolute = sums.absolute / values;
  result.mean_squared = sums.squared / values;
  result.relative_mean_squared = sums.relative / values;
  return result;
}

}  // namespace candil
