/// What the decoders share of OpenImageIO. Only for .cpp files of io/.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <string>

#include "io/image_decoder.h"
#include "io/temporary_file.h"

namespace candil {

/// The library's reader of a format. Not for PFM and PPM. Throws std::runtime_error where this library has none.
std::unique_ptr<OIIO::ImageInput> create_image_input(ImageFormat format);

/// Opens a file that outlives the use of `input`; `spec` becomes that of its first image. Throws std::runtime_error
/// with one line.
void open_image(OIIO::ImageInput& input, OIIO::Filesystem::IOProxy& file, OIIO::ImageSpec& spec);
/// For readers that do not support "ioproxy".
void open_image(OIIO::ImageInput& input, const TemporaryFile& file, OIIO::ImageSpec& spec);

/// Throws std::runtime_error for an image that is empty, too large, or larger than the file can mean.
void check_size(const OIIO::ImageSpec& spec, std::size_t encoded_bytes);

/// Throws std::runtime_error for kinds of images that are not supported.
void check_kind(const OIIO::ImageSpec& spec);

/// The first line of what the library complains about.
std::string first_line(const std::string& message);

}  // namespace candil
