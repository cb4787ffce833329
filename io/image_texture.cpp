#include <stdexcept>

#include "io/error.h"
#include "io/image_decoder.h"
#include "io/image_file.h"
#include "io/image_reader.h"
#include "io/ktx2_container.h"
#include "io/ktx2_texture.h"

namespace candil {
namespace {

/// Widens 1 to 4 channels to RGBA: grey is copied, absent alpha is `one`.
template <typename Pixel, typename Value>
std::vector<Pixel> read_rgba(ImageReader& reader, Value one) {
  std::vector<Pixel> pixels(static_cast<std::size_t>(reader.width()) * static_cast<std::size_t>(reader.height()),
                            Pixel(one));
  reader.read(&pixels[0].x, 4);
  if (reader.channels() > 2) return pixels;
  for (Pixel& pixel : pixels) {
    if (reader.channels() == 2) pixel.w = pixel.y;
    pixel.y = pixel.z = pixel.x;
  }
  return pixels;
}

bool is_texture_format(ImageFormat format) {
  return format == ImageFormat::png || format == ImageFormat::jpeg || format == ImageFormat::webp ||
         format == ImageFormat::avif;
}

}  // namespace

TextureImage decode_texture(std::span<const std::byte> encoded, const std::string& name, const std::string& file,
                            const std::string& place) {
  try {
    if (is_ktx2(encoded)) {
      TextureImage texture = decode_ktx2(encoded);
      texture.name = name;
      return texture;
    }
    const std::optional<ImageFormat> format = detect_image_format(encoded);
    if (!format || !is_texture_format(*format)) throw std::runtime_error("not a PNG, JPEG, WebP, AVIF or KTX2 image");
    ImageReader reader(encoded, *format);
    TextureImage texture;
    texture.name = name;
    texture.width = reader.width(), texture.height = reader.height();
    texture.has_alpha = reader.channels() % 2 == 0;
    if (reader.is_8_bit()) {
      texture.rgba8 = read_rgba<glm::u8vec4, std::uint8_t>(reader, 255);
    } else {
      texture.rgba32 = read_rgba<Vec4, float>(reader, 1.0f);
    }
    return texture;
  } catch (const std::runtime_error& error) {
    throw InputError(file, place, name + ": " + error.what());
  }
}

}  // namespace candil
