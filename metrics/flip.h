/// FLIP: how much a person notices when two images alternate on a screen, from 0 (nothing) to 1.
/// Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"; for images of high dynamic range
/// Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images" (the largest FLIP over a range of
/// exposures).
#pragma once

#include <optional>

#include "metrics/image_pair.h"

namespace candil {

/// Exposures in stops, evenly from start to stop.
struct FlipExposures {
  float start = 0, stop = 0;  ///< start <= stop.
  int count = 1;

  float stops(int i) const {
    return count > 1 ? start + static_cast<float>(i) * (stop - start) / static_cast<float>(count - 1) : start;
  }
};

/// A screen of 3840 pixels and 0.7 m, seen from 0.7 m: the observer of the paper.
inline constexpr double default_pixels_per_degree = 67.02064327658226;

struct FlipSettings {
  double pixels_per_degree = default_pixels_per_degree;  ///< 1 to 1000.
  std::optional<FlipExposures> exposures;                ///< For linear images; absent: flip_exposures() of A.
};

struct Flip {
  Image map;                               ///< One channel.
  std::optional<FlipExposures> exposures;  ///< That were used, for linear images.
};

/// The exposures at which a reference is worth looking at (section 4 of the paper of 2021): from the one that shows its
/// brightest pixel at 0.85 of the screen's range to the one that shows its median so, one stop apart or a little less.
FlipExposures flip_exposures(const Image& reference);

/// `pair` is colour; alpha is ignored: what is transparent is seen over black. Display images give the FLIP of 2020,
/// linear ones that of 2021 with the ACES curve. Negative values and NaN are seen as black; a pixel where values differ
/// that are not finite has 1.
Flip measure_flip(const ImagePair& pair, const FlipSettings& settings = {});

}  // namespace candil
