/// Pixels out of encoded bytes: the reader of OpenImageIO, behind plain types.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace candil {

/// The formats that are read at all, whatever else the library could do.
enum class ImageFormat { png, jpeg, webp, avif, hdr, exr, pfm, ppm, tiff };

/// Tells the format by the first bytes, never by the name; nothing for any other kind of file.
std::optional<ImageFormat> detect_image_format(std::span<const std::byte> encoded);

/// Whether the OpenImageIO that is linked has a reader for the format; it may be made without those of WebP and AVIF.
bool can_read(ImageFormat format);

/// Pixels as stored, rows from top to bottom, channels interleaved; exactly one of the two vectors is filled.
struct DecodedImage {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> bytes;  ///< Files of 8 bits a channel.
  std::vector<float> floats;        ///< All others; integers scaled to [0, 1].
  bool is_linear = false;           ///< Radiance; otherwise values for a display (sRGB), as in files of integers.
  bool is_unassociated = false;     ///< Colour is not multiplied by alpha.
};

/// Largest width and height that is decoded, pixels.
inline constexpr int max_image_size = 16384;

/// Throws std::runtime_error for an image that is empty, too large, or larger than the file can mean.
void check_image_size(std::int64_t width, std::int64_t height, std::size_t encoded_bytes);

/// Decodes the first image of a file, with 1 to 4 channels; files with more give their R, G, B and the A beside them.
/// No colour conversion; alpha stays unassociated where the format has it so. Sizes are checked before any pixel is
/// decoded, and against the length of the file. Throws std::runtime_error with one line that does not name the file.
DecodedImage decode_image(std::span<const std::byte> encoded, ImageFormat format);

}  // namespace candil
