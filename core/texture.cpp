#include "core/texture.h"

#include "core/color.h"

namespace candil {
namespace {

/// Coordinate in [0, 1] after wrapping; non-finite coordinates become 0.
float wrap_coordinate(float t, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      t -= std::floor(t);
      break;
    case Wrap::clamp:
      t = glm::clamp(t, 0.0f, 1.0f);
      break;
    case Wrap::mirror:
      t -= 2 * std::floor(0.5f * t);
      t = t > 1 ? 2 - t : t;
      break;
  }
  return t >= 0 && t <= 1 ? t : 0;
}

/// A texel index one step outside of [0, size) brought back.
int wrap_texel(int i, int size, Wrap wrap) {
  if (i >= 0 && i < size) return i;
  if (wrap == Wrap::repeat) return i < 0 ? size - 1 : 0;
  return i < 0 ? 0 : size - 1;  // clamp, and the mirrored neighbour of a border texel is itself
}

Vec4 texel(const TextureImage& image, int x, int y, ColorSpace space) {
  const std::size_t index = static_cast<std::size_t>(y) * image.width + x;
  if (!image.rgba8.empty()) {
    const glm::u8vec4 t = image.rgba8[index];
    const auto& table = space == ColorSpace::srgb ? linear_of_srgb_byte : linear_of_byte;
    return {table[t.x], table[t.y], table[t.z], linear_of_byte[t.w]};
  }
  const Vec4 t = image.rgba32[index];
  if (space == ColorSpace::linear) return t;
  return {srgb_to_linear(t.x), srgb_to_linear(t.y), srgb_to_linear(t.z), t.w};
}

}  // namespace

Vec4 sample_texture(const Scene& scene, const TextureSlot& slot, const Vec2 (&uv)[2], ColorSpace space) {
  const Texture& texture = scene.textures[slot.texture];
  const TextureImage& image = scene.images[texture.image];
  const Vec3 source(uv[slot.uv_set], 1);
  const float u = wrap_coordinate(glm::dot(slot.row_u, source), texture.wrap_u);
  const float v = wrap_coordinate(glm::dot(slot.row_v, source), texture.wrap_v);
  const float x = u * static_cast<float>(image.width), y = v * static_cast<float>(image.height);
  if (texture.filter == Filter::nearest) {
    return texel(image, glm::min(static_cast<int>(x), image.width - 1), glm::min(static_cast<int>(y), image.height - 1),
                 space);
  }
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float fx = x - 0.5f - left, fy = y - 0.5f - top;
  const int x0 = wrap_texel(static_cast<int>(left), image.width, texture.wrap_u);
  const int x1 = wrap_texel(static_cast<int>(left) + 1, image.width, texture.wrap_u);
  const int y0 = wrap_texel(static_cast<int>(top), image.height, texture.wrap_v);
  const int y1 = wrap_texel(static_cast<int>(top) + 1, image.height, texture.wrap_v);
  const Vec4 upper = glm::mix(texel(image, x0, y0, space), texel(image, x1, y0, space), fx);
  const Vec4 lower = glm::mix(texel(image, x0, y1, space), texel(image, x1, y1, space), fx);
  return glm::mix(upper, lower, fy);
}

}  // namespace candil
