/// Whether two renders of the same number of samples were made by different programs, or of different scenes.
///
/// If nothing but chance tells A from B, they may be exchanged in any pixel: the differences of a channel are as likely
/// up as down, whatever their sizes, and independently from pixel to pixel. Given the sizes s, the sum of n of them
/// with such signs lies z = sum / sqrt(sum of squares) or more from 0 with a probability of at most 2 exp(-z^2 / 2)
/// (Hoeffding 1963, "Probability Inequalities for Sums of Bounded Random Variables", theorem 2). No assumption about
/// the distribution of samples is made.
///
/// s = (b - a) / (b + a): a lone bright pixel counts no more than others. Renders of the same seed make the same paths
/// wherever nothing has changed, differences there are 0, and a change of 1 % of a material shows as s = 0.005 in every
/// pixel of it: far below the noise, and yet all of one sign. On another processor some paths turn another way, up as
/// often as down.
///
/// Every aligned square of 4, 8, 16, ... pixels up to the whole image is a test of its own for each channel; their
/// number corrects the smallest p-value (Bonferroni).
#pragma once

#include "metrics/image_pair.h"

namespace candil {

struct SignTest {
  double p_value = 1;  ///< An upper bound.
  double log10_p_value = 0;
  Region region;  ///< The square with the smallest one, and
  int channel = 0;
  double z = 0;  ///< its deviation, positive where B is brighter.
};

/// Of the first three channels. Values that differ by no more than `rounding` as a share of the larger one count as
/// equal. Pixels with values that are negative or not finite are left out: other metrics see them.
SignTest measure_sign_test(const ImagePair& pair, const PixelSelection& selection, float rounding);

}  // namespace candil
