#include "metrics/differences.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "metrics/parallel_rows.h"
#include "metrics/pixel_rows.h"

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

/// Bits of the size of a float: in the order of the sizes.
std::uint32_t size_bits(float value) { return std::bit_cast<std::uint32_t>(value) & 0x7fffffffu; }

/// The error of all pixels of a row; what is the largest, as bits, and how many have any.
template <int channels>
std::pair<std::uint32_t, std::size_t> write_errors(const float* __restrict a, const float* __restrict b, int width,
                                                   float* __restrict error) {
  std::uint32_t row_largest = 0, different = 0;
  for (int x = 0; x < width; ++x) {
    std::uint32_t largest = 0;
    for (int c = 0; c < channels; ++c)
      largest = std::max(largest, size_bits(b[x * channels + c] - a[x * channels + c]));
    error[x] = std::bit_cast<float>(largest);
    row_largest = std::max(row_largest, largest);
    different += largest != 0 ? 1 : 0;
  }
  return {row_largest, different};
}

/// As measure_row() for a row that counts as a whole, in a form that compilers vectorise. False: there are values or
/// differences that are not finite.
template <int channels>
bool measure_whole_row(const ImagePair& pair, int y, float* error, RowSums& sums) {
  const float *a = pair.a.pixel(0, y), *b = pair.b.pixel(0, y);
  const int width = pair.width();
  const auto count = static_cast<std::size_t>(width) * channels;
  if (!is_finite_row(a, count) || !is_finite_row(b, count)) return false;
  const auto [largest, different] = write_errors<channels>(a, b, width, error);
  sums.largest = std::bit_cast<float>(largest);
  if (!std::isfinite(sums.largest)) return false;
  sums.different_pixels = different;
  if (different > 0) {
    sums.largest_y = y;
    sums.largest_x = static_cast<int>(std::find(error, error + width, sums.largest) - error);
    const std::size_t at = static_cast<std::size_t>(sums.largest_x) * channels;
    while (size_bits(b[at + static_cast<std::size_t>(sums.largest_channel)] -
                     a[at + static_cast<std::size_t>(sums.largest_channel)]) != largest)
      ++sums.largest_channel;
  }
  std::uint32_t peak = 0;
  for (std::size_t i = 0; i < count; ++i) peak = std::max(peak, size_bits(a[i]));
  sums.peak = std::bit_cast<float>(peak);

  // Every lane is of one channel.
  constexpr std::size_t lanes = 12;
  double deltas[lanes] = {}, sizes[lanes] = {}, squares[lanes] = {}, relatives[lanes] = {};
  const auto add = [&](std::size_t i, std::size_t lane) {
    const double delta = b[i] - a[i], square = delta * delta, wanted = a[i];
    deltas[lane] += delta;
    sizes[lane] += std::abs(delta);
    squares[lane] += square;
    relatives[lane] += square / (wanted * wanted + relative_floor);
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) add(i + lane, lane);
  for (std::size_t lane = 0; i + lane < count; ++lane) add(i + lane, lane);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    sums.signed_sums[lane % channels] += deltas[lane];
    sums.absolute += sizes[lane], sums.squared += squares[lane], sums.relative += relatives[lane];
  }
  return true;
}

RowSums measure_any_row(const ImagePair& pair, const PixelSelection& selection, int y, float* error) {
  const int channels = pair.a.channels;
  if (selection.is_everything() && (channels == 3 || channels == 4)) {
    RowSums sums;
    sums.signed_sums.resize(static_cast<std::size_t>(channels));
    if (channels == 3 ? measure_whole_row<3>(pair, y, error, sums) : measure_whole_row<4>(pair, y, error, sums))
      return sums;
  }
  return measure_row(pair, selection, y, error);
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
  const auto sums = sum_rows<RowSums>(
      pair.height(), [&](int y) { return measure_any_row(pair, selection, y, result.error.pixel(0, y)); });
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
