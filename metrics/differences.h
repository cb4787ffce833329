/// Metrics that look at one value at a time: d = b - a for every channel of every pixel that counts.
#pragma once

#include <cstddef>
#include <vector>

#include "metrics/image_pair.h"

namespace candil {

/// Values that are not finite: two NaN, or twice the same infinity, are equal; any other pair with one of them differs
/// by infinity, so that no threshold lets it pass. Means are over pixels and channels, alpha included.
struct Differences {
  std::size_t pixels = 0;                                 ///< That count.
  std::size_t different_pixels = 0;                       ///< With any d other than 0.
  std::size_t non_finite_pixels = 0;                      ///< With a d of infinity.
  double largest = 0;                                     ///< max |d|.
  int largest_x = 0, largest_y = 0, largest_channel = 0;  ///< Where it is first met, row by row.
  double mean_absolute = 0;                               ///< Mean |d|.
  double mean_squared = 0;                                ///< MSE: mean d^2.
  double relative_mean_squared = 0;                       ///< relMSE: mean d^2 / (a^2 + 0.01).
  double peak = 1;           ///< What PSNR relates to: 1 for display values, else the largest finite |a|.
  std::vector<double> bias;  ///< For each channel: mean d.
  Image error;               ///< One channel: the largest |d| of the pixel, whether it counts or not.

  double root_mean_squared() const;
  /// 10 log10(peak^2 / MSE), decibels; infinite for equal images.
  double peak_signal_to_noise() const;
  /// The bias that is farthest from 0.
  double largest_bias() const;
};

/// The 0.01 of relMSE: keeps dark pixels from counting without bounds (Rousselle et al. 2011, Adaptive Sampling and
/// Reconstruction using Greedy Error Minimization, section 3).
inline constexpr double relative_floor = 0.01;

Differences measure_differences(const ImagePair& pair, const PixelSelection& selection);

}  // namespace candil
