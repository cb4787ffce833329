/// Images in files, through OpenImageIO. Formats are an allow-list; sizes are checked before pixels are decoded.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/image.h"

namespace candil {

/// Decodes a texture (PNG, JPEG, KTX2; WebP and AVIF where the library has them) in memory. Pixels stay as stored:
/// colour space hints in the file (gAMA, ICC) are ignored, as glTF demands. `name` is used in messages and kept. Throws
/// InputError(file, place, ...) when it cannot be decoded, is of another kind, or larger than 16384 x 16384.
TextureImage decode_texture(std::span<const std::byte> encoded, const std::string& name, const std::string& file,
                            const std::string& place);

/// Reads any image that is supported (EXR, HDR, PFM, TIFF, PPM of every PpmKind, PNG, JPEG, WebP) as linear values: 3
/// channels, or 4 with premultiplied alpha where the file has alpha; grey is copied to R, G and B. Integer files, but
/// for PPM of kind hdr, hold sRGB and are made linear; float files are taken as they are, negative and non-finite
/// values too. EXR files of several layers give the first set of R, G, B (and A). Throws InputError.
Image read_image(const std::filesystem::path& path);

/// Reads an environment, any image that read_image() knows, as three linear float channels. Negative values, which
/// resampling leaves in many published environments, become 0. Throws InputError; a non-finite value is an error that
/// names the pixel.
Image read_environment(const std::filesystem::path& path);

/// Key and value pairs for the header of files that can carry them (EXR), e.g. {"candil:seed", "7"}.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

/// An image as its file has it, layer by layer.
struct LayeredImage {
  int width = 0, height = 0;
  bool is_linear = false;        ///< Else the values are for a display: sRGB in [0, 1].
  bool is_8_bit = false;         ///< All values are multiples of 1/255.
  bool has_half_floats = false;  ///< Values are rounded to 11 bits.
  /// All that the file has, in its order. The picture itself has no name; other channels without a layer are layers of
  /// their own ("Z").
  std::vector<std::string> names;
  /// Those that were wanted, in the same order; channels of colour as R, G, B (and A, by which they are multiplied).
  std::vector<ImageLayer> layers;
  ImageMetadata metadata;  ///< The texts of the header (EXR).
};

/// From the names of all layers those to read.
using LayerChoice = std::function<std::vector<std::string>(const std::vector<std::string>& names)>;
inline constexpr std::size_t max_layer_channels = 16;

/// Reads the layers that `choose` picks of any image that read_image() knows. All formats but EXR have the picture
/// alone. Values stay as they are stored, but for colours, which get multiplied by the alpha of their pixel where the
/// file does not have them so; grey is copied to R, G and B. Throws InputError.
LayeredImage read_layers(const std::filesystem::path& path, const LayerChoice& choose);

/// What is written to .ppm files (io/image_ppm.h): display values, binary (P6) or ascii (P3), or linear ones with a
/// maximum (hdr).
enum class PpmKind { binary, ascii, hdr };

/// True when write_image() knows the extension: .exr .hdr .pfm (linear); .png .jpg .jpeg .tif .tiff .ppm (display).
bool is_writable_image(const std::filesystem::path& path);
/// True for the formats that store scene-linear values: .exr .hdr .pfm, and .ppm where it is to be PpmKind::hdr.
bool is_linear_format(const std::filesystem::path& path, PpmKind ppm = PpmKind::binary);
/// True for the formats that can store alpha: .exr .png .tif .tiff.
bool has_alpha_channel(const std::filesystem::path& path);

/// Writes beside the target and renames, so that the target is whole or untouched. `image` holds linear values for
/// linear formats (premultiplied alpha) and display values in [0, 1] for the others (unassociated alpha; 8 bits). The
/// alpha channel is written only if `with_alpha` and the format has one. Throws OutputError.
void write_image(const std::filesystem::path& path, const Image& image, bool with_alpha, const ImageMetadata& metadata,
                 PpmKind ppm = PpmKind::binary);

/// True for the formats that hold further layers beside the picture: .exr.
bool has_layers(const std::filesystem::path& path);

/// Writes several images into one EXR file, each channel as "LAYER.CHANNEL" ("depth.Z"), or "CHANNEL" alone for the
/// layer without a name. All values stay the floats that they are. The layers have the same size and names of their
/// own. Programs that know nothing of layers, and read_image(), see the layer without a name. Atomic like
/// write_image(); throws OutputError.
void write_layers(const std::filesystem::path& path, std::span<const ImageLayer> layers, const ImageMetadata& metadata);

/// How hard PNG files are compressed, from 1 (quick) to 9 (small).
inline constexpr int default_png_level = 6;

/// An 8-bit PNG in memory, for standard output and reports. `display` is as for write_image(). Throws OutputError.
std::vector<std::byte> encode_png(const Image& display, bool with_alpha, int level = default_png_level);

/// "2.4.7": the version of the library that is linked.
std::string openimageio_version();

}  // namespace candil
