/// The filters of FLIP for a viewing distance.
#pragma once

#include "metrics/row_filter.h"

namespace candil {

struct FlipFilters {
  /// Contrast sensitivity of the eye (section 4.1.1 of the paper of 2020): one Gaussian for luminance and for
  /// red-green; the sum of two for blue-yellow, the weights of which are part of the filters along rows.
  HalfKernel luminance, red_green, blue_yellow_wide, blue_yellow_narrow;
  HalfKernel blue_yellow_wide_along, blue_yellow_narrow_along;
  /// Edges and points of luminance (section 4.2): a Gaussian and its first and second derivative, the positive weights
  /// of which sum up to 1 like the negative ones.
  HalfKernel smooth, edge, point;

  int radius = 0;  ///< The largest of them.
};

FlipFilters make_flip_filters(double pixels_per_degree);

}  // namespace candil
