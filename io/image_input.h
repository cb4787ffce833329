/// What the decoders share of OpenImageIO. Only for .cpp files of io/.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <string>

#include "io/image_decoder.h"

namespace candil {

/// Opens a file in memory or on disk, which outlives what is returned; `spec` becomes that of its first image. Not for
/// PFM and PPM. Throws std::runtime_error with one line.
std::unique_ptr<OIIO::ImageInput> open_image(OIIO::Filesystem::IOProxy& file, ImageFormat format,
                                             OIIO::ImageSpec& spec);

/// Throws std::runtime_error for an image that is empty, too large, or larger than the file can mean.
void check_size(const OIIO::ImageSpec& spec, std::size_t encoded_bytes);

/// Throws std::runtime_error for kinds of images that are not supported.
void check_kind(const OIIO::ImageSpec& spec);

/// The first line of what the library complains about.
std::string first_line(const std::string& message);

}  // namespace candil
