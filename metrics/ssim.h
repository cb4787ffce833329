/// Structural similarity. Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to
/// Structural Similarity".
#pragma once

#include "metrics/image_pair.h"

namespace candil {

/// The index of every pixel, from -1 to 1 (equal surroundings): of the luma (0.2126, 0.7152, 0.0722) of display values,
/// for linear images those of a screen that cuts at 1 (sRGB curve). Gaussian window of 11 x 11 and sigma 1.5, K1 =
/// 0.01, K2 = 0.03, dynamic range 1. At the border the window is cut and its weights are scaled up. A pixel where
/// values differ that are not finite has 0. `pair` is colour; alpha is ignored.
Image measure_ssim(const ImagePair& pair);

/// The pixels over which the index is to be averaged, as the authors do: those that the whole window fits around. If
/// none of the selection are, all of it.
PixelSelection ssim_selection(const PixelSelection& selection);

}  // namespace candil
