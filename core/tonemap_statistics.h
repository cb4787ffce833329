/// What tone mapping operators want to know about a whole image.
#pragma once

#include <cstddef>

#include "core/image.h"

namespace candil {

using DVec3 = glm::dvec3;

/// All in the image's linear units. Sums are taken in double precision from the first pixel to the last. Pixels with
/// a channel that is not finite are left out, as are the empty ones (black with an alpha of 0); negative values count
/// as 0. Luminance is that of Rec.709.
///
/// "Lit" pixels are those brighter than 1e-9 of the mean luminance. Only they count where logarithms are taken: the
/// logarithm of black is minus infinity, and one of nearly black pixels says more about their number than about light.
/// All is 0 in an image without lit pixels.
struct ImageStatistics {
  double maximum = 0;            ///< Largest channel of any pixel.
  double mean_luminance = 0;     ///< Of all pixels.
  DVec3 mean_color = DVec3(0);   ///< Of all pixels.
  double lowest_luminance = 0;   ///< Of lit pixels.
  double highest_luminance = 0;  ///< Of lit pixels.
  double log_average = 0;        ///< exp of the mean log luminance of lit pixels.
};

/// Of an RGB image, or of the colours of an RGBA one (premultiplied) before they were multiplied by alpha.
ImageStatistics measure_image(const Image& linear);

/// Rec.709 luminance.
double precise_luminance(DVec3 color);

/// The colour of a pixel of 3 or 4 channels, not premultiplied; where alpha is 0, the colour as stored.
DVec3 straight_color(const float* pixel, int channels);

/// Light that can be computed with: NaN and negative values become 0, infinity the largest float.
DVec3 usable_light(DVec3 color);

/// True for a pixel whose three colour channels are finite.
bool has_finite_color(const float* pixel);

/// Calls `visit` with the straight, usable colour of each pixel that counts, in the order of the image.
template <typename Visitor>
void for_each_color(const Image& image, const Visitor& visit) {
  const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
  for (std::size_t i = 0; i < count; ++i) {
    const float* const pixel = &image.pixels[i * image.channels];
    if (!has_finite_color(pixel)) continue;
    const DVec3 color = usable_light(straight_color(pixel, image.channels));
    const bool is_empty = image.channels == 4 && pixel[3] == 0 && color == DVec3(0);
    if (!is_empty) visit(color);
  }
}

}  // namespace candil
