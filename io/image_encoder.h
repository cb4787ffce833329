/// Encoded bytes out of pixels: the only writer of OpenImageIO, behind plain types.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "io/image_file.h"

namespace candil {

/// `extension` is lower case with its dot, one that is_writable_image() knows; pixels, alpha and PPM kind as for
/// write_image(). The same arguments give the same bytes: no time stamps. `png_level` is the effort of PNG files, from
/// 1 (quick) to 9 (small). Throws std::runtime_error with one line.
std::vector<std::byte> encode_image(const std::string& extension, const Image& image, bool with_alpha,
                                    const ImageMetadata& metadata, PpmKind ppm, int png_level = default_png_level);

/// An EXR file, as for write_layers(). Throws std::runtime_error with one line.
std::vector<std::byte> encode_layers(std::span<const ImageLayer> layers, const ImageMetadata& metadata);

}  // namespace candil
