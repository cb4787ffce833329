#include "io/image_file.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "io/atomic_file.h"
#include "io/error.h"
#include "io/image_encoder.h"

namespace candil {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension;
}

template <typename Encode>
void write_encoded(const std::filesystem::path& path, const Encode& encode) {
  std::vector<std::byte> encoded;
  try {
    encoded = encode();
  } catch (const std::runtime_error& error) {
    throw OutputError(path.string(), error.what());
  }
  write_file_atomically(path, encoded);
}

}  // namespace

bool is_linear_format(const std::filesystem::path& path, PpmKind ppm) {
  const std::string extension = lower_extension(path);
  if (extension == ".ppm") return ppm == PpmKind::hdr;
  return extension == ".exr" || extension == ".hdr" || extension == ".pfm";
}

bool has_alpha_channel(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".exr" || extension == ".png" || extension == ".tif" || extension == ".tiff";
}

bool has_layers(const std::filesystem::path& path) { return lower_extension(path) == ".exr"; }

bool is_writable_image(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 6> display = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".ppm"};
  return is_linear_format(path) || std::ranges::find(display, lower_extension(path)) != display.end();
}

void write_image(const std::filesystem::path& path, const Image& image, bool with_alpha, const ImageMetadata& metadata,
                 PpmKind ppm) {
  if (!is_writable_image(path)) throw OutputError(path.string(), "unknown image format");
  write_encoded(path, [&] { return encode_image(lower_extension(path), image, with_alpha, metadata, ppm); });
}

void write_layers(const std::filesystem::path& path, std::span<const ImageLayer> layers,
                  const ImageMetadata& metadata) {
  if (!has_layers(path)) throw OutputError(path.string(), "the format has no layers");
  write_encoded(path, [&] { return encode_layers(layers, metadata); });
}

std::vector<std::byte> encode_png(const Image& display, bool with_alpha, int level) {
  try {
    return encode_image(".png", display, with_alpha, {}, PpmKind::binary, level);
  } catch (const std::runtime_error& error) {
    throw OutputError("standard output", error.what());
  }
}

std::string openimageio_version() {
  const int version = OIIO::openimageio_version();  // 20407 for 2.4.7
  return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

}  // namespace candil
