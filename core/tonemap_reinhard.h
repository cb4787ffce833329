/// The two operators of Erik Reinhard that adapt to the whole image. The classic trouble with them is overflow and
/// logarithms of black; here sums and squares are doubles and black pixels do not count (tonemap_statistics.h).
#pragma once

#include "core/tonemap.h"
#include "core/tonemap_statistics.h"

namespace candil {

/// Reinhard, Stark, Shirley, Ferwerda: "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, the global
/// operator, equations 1, 2 and 4:
///   average = exp(mean of log L)                     over lit pixels
///   scaled  = key / average * L
///   shown   = scaled (1 + scaled / white^2) / (1 + scaled)
/// `white` is the smallest scaled luminance that becomes 1; 0 takes that of the brightest pixel. Colours keep their
/// proportions: RGB times shown / L, which may leave [0, 1] for saturated ones. Gives display-linear light.
/// `color` is finite and not negative.
DVec3 reinhard02_tonemap(const Tonemap& tonemap, const ImageStatistics& statistics, DVec3 color);

/// Reinhard, Devlin: "Dynamic Range Reduction Inspired by Photoreceptor Physiology", IEEE TVCG 11(1), 2005. For each
/// channel I of a pixel of luminance L:
///   shown      = I / (I + (exp(-intensity) adaptation)^contrast)
///   adaptation = light (color I + (1 - color) L) + (1 - light) (color mean I + (1 - color) mean L)
/// as a share of the range that the image's channels give, the paper's normalisation. Gives display-linear light.
struct Photoreceptor {
  Tonemap tonemap;
  ImageStatistics statistics;
  double contrast = 1;       ///< The one that is used.
  double low = 0, high = 1;  ///< Range of the responses in the image; [0, 1] when all are equal.
};

/// `linear` is the image that was measured. A contrast of 0 is chosen by the image as in the paper:
///   0.3 + 0.7 k^1.4,  k = (log max - log average) / (log max - log min),  1/2 for an image of one luminance.
Photoreceptor make_photoreceptor(const Tonemap& tonemap, const ImageStatistics& statistics, const Image& linear);

/// `color` is finite and not negative.
DVec3 reinhard05_tonemap(const Photoreceptor& receptor, DVec3 color);

}  // namespace candil
