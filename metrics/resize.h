/// Images of another size.
#pragma once

#include "core/image.h"

namespace candil {

/// Resampled by a triangle (bilinear) that is as wide as a pixel of the coarser of the two images, so that shrinking
/// averages. Both sizes are at least 1.
Image resize_image(const Image& image, int width, int height);

}  // namespace candil
