#include <stdexcept>

#include "io/error.h"
#include "io/image_decoder.h"
#include "io/image_file.h"
#include "io/ktx2_container.h"
#include "io/ktx2_texture.h"

namespace candil {
namespace {

/// Widens 1 to 4 channels to RGBA: grey is copied, absent alpha is `one`.
template <typename Value, typename Pixel>
std::vector<Pixel> to_rgba(const std::vector<Value>& values, int channels, Value one) {
  const bool is_grey = channels < 3, has_alpha = channels == 2 || channels == 4;
  std::vector<Pixel> pixels(values.size() / channels);
  const Value* value = values.data();
  for (Pixel& pixel : pixels) {
    pixel = is_grey ? Pixel(value[0], value[0], value[0], one) : Pixel(value[0], value[1], value[2], one);
    if (has_alpha) pixel.w = value[channels - 1];
    value += channels;
  }
  return pixels;
}

bool is_texture_format(ImageFormat format) {
  return format == ImageFormat::png || format == ImageFormat::jpeg || format == ImageFormat::webp;
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
    if (!format || !is_texture_format(*format)) throw std::runtime_error("not a PNG, JPEG, WebP or KTX2 image");
    const DecodedImage decoded = decode_image(encoded, *format);
    TextureImage texture;
    texture.name = name;
    texture.width = decoded.width, texture.height = decoded.height;
    texture.has_alpha = decoded.channels == 2 || decoded.channels == 4;
    texture.rgba8 = to_rgba<std::uint8_t, glm::u8vec4>(decoded.bytes, decoded.channels, 255);
    texture.rgba32 = to_rgba<float, Vec4>(decoded.floats, decoded.channels, 1.0f);
    return texture;
  } catch (const std::runtime_error& error) {
    throw InputError(file, place, name + ": " + error.what());
  }
}

}  // namespace candil
