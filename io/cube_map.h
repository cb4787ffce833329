/// Cube maps as environments.
#pragma once

#include <array>

#include "core/image.h"

namespace candil {

/// Radiance from everywhere on the six faces of a cube, seen from its middle: +X, -X, +Y, -Y, +Z, -Z. Each is upright
/// and not mirrored for an eye that looks at it with +Y up; above, -Z is up, below, +Z. Square images of three channels
/// and of one size.
using CubeFaces = std::array<Image, 6>;

/// The cube as Environment::image, bilinear in each face and averaged over the texels; turned as `rotation` turns
/// things. As fine as the middle of a face, up to 8192 x 4096.
Image to_latitude_longitude(const CubeFaces& faces, const Mat3& rotation);

}  // namespace candil
