/// Whether two noisy images differ by more than their noise: for renders that carry the variance of their pixels.
///
/// Every pixel and channel, and every aligned square of 2, 4, 8, ... pixels up to the whole image, is a test of its
/// own: d = sum of (b - a), over its standard error. A change of 1 % that no single pixel shows stands out in the sums.
///
/// - Standard error. Renders that differ only in their seed share their variance per sample, so that both estimates are
///   pooled; the larger of that and of the separate estimates (Welch) counts. The one is safe where few samples have
///   missed rare bright paths and believe to be exact, the other where they have met some by chance.
/// - Few samples. The deviation is held against Student's distribution with the degrees of freedom of the variances
///   (Satterthwaite). If nothing but the seed differs, all ways to deal the samples of a pixel to the two images are
///   equally likely: its p-value is not taken for smaller than one of them allows. For squares, likewise, the signs of
///   the pixels' differences are as good as drawn by lot. The standard error is then no smaller than the root of the
///   sum of their squares, and the p-value no smaller than Hoeffding's bound for it, 2 exp(-z^2 / 2) (Efron 1969,
///   "Student's t-Test under Symmetry Conditions"), whatever the distribution of the samples: one pixel that is far off
///   by chance does not make its neighbourhood so.
/// - Many tests. Within one size of squares, Benjamini and Hochberg (1995): where nothing has changed it raises a false
///   alarm as rarely as Sidak's correction does, and it finds changes that are spread over many pixels, which the
///   latter, looking at the worst one alone, does not. The sizes, which share their pixels, are corrected by their
///   number (Bonferroni).
#pragma once

#include "metrics/image_pair.h"

namespace candil {

/// The variance of one image's mean, channel by channel (3; the first three of the image), and the number of samples
/// per pixel that it comes from; 0 where it is not known (then the noise is taken for normal).
struct ImageVariance {
  const Image& variance;
  std::uint32_t samples = 0;
};

struct ZTestSettings {
  /// What rounding may change, as a share of the values: other processors, or files of half floats (5e-4).
  float rounding = 1e-5f;
};

struct ZTest {
  /// The chance that noise alone makes images as different as these somewhere. Meant for small values: above 0.001
  /// it may be too large.
  double p_value = 1;
  double log10_p_value = 0;  ///< At least -1000.
  /// Tests of single pixels and channels, and how many of them stand out (p below 0.001 after the correction).
  std::size_t pixel_tests = 0, significant_pixel_tests = 0;

  /// The square that stands out most.
  struct Place {
    Region region;
    int channel = 0;
    double deviation = 0;  ///< d over its standard error; positive: B is brighter.
    double mean_a = 0;     ///< Of the square.
    double mean_difference = 0;
  } worst;
};

/// `pair` is linear colour; both variances have its size. Pixels with values that differ and are not finite are
/// changes for certain; variances that are negative or not finite count as 0.
ZTest measure_z_test(const ImagePair& pair, const ImageVariance& a, const ImageVariance& b,
                     const PixelSelection& selection, const ZTestSettings& settings = {});

}  // namespace candil
