#include <bit>
#include <cmath>

#include "core/color.h"
#include "io/bump_map.h"
#include "io/image_file.h"
#include "io/json_internal.h"
#include "io/resource.h"

namespace candil {
namespace {

Vec4 encoded(Vec4 linear) {
  return {linear_to_srgb(linear.x), linear_to_srgb(linear.y), linear_to_srgb(linear.z), linear.w};
}

/// Colours as sRGB from colours that are stored linear.
TextureImage encode_linear(const TextureImage& image) {
  TextureImage result;
  result.name = image.name;
  result.width = image.width, result.height = image.height;
  result.has_alpha = image.has_alpha;
  for (const glm::u8vec4 t : image.rgba8) result.rgba32.push_back(encoded(Vec4(t) / 255.0f));
  for (const Vec4 t : image.rgba32) result.rgba32.push_back(encoded(t));
  return result;
}

/// Two by two texels of linear values.
TextureImage make_checkerboard(const JsonNode& colors) {
  TextureImage image;
  image.name = colors.place();
  image.width = image.height = 2;
  const Vec4 first(colors[0].color(), 1), second(colors[1].color(), 1);
  image.rgba32 = {first, second, second, first};
  return image;
}

/// Of each channel, of colours that are stored as sRGB.
Vec3 largest_linear(const TextureImage& image) {
  Vec3 largest(0);
  glm::u8vec4 largest_byte(0);
  for (const glm::u8vec4 t : image.rgba8) largest_byte = glm::max(largest_byte, t);
  for (int c = 0; c < 3; ++c) largest[c] = linear_of_srgb_byte[largest_byte[c]];
  for (const Vec4 t : image.rgba32)
    for (int c = 0; c < 3; ++c) largest[c] = glm::max(largest[c], srgb_to_linear(t[c]));
  return largest;
}

Wrap read_wrap(const JsonNode& texture) {
  const std::string wrap = texture.text("wrap", "repeat");
  return wrap == "clamp" ? Wrap::clamp : wrap == "mirror" ? Wrap::mirror : Wrap::repeat;
}

Vec2 read_repeat(const JsonNode& texture) {
  const auto repeat = texture.find("repeat");
  if (!repeat) return Vec2(1);
  return repeat->is_array() ? repeat->vec2() : Vec2(repeat->number());
}

/// A normal map as it is along the texture coordinates of the surface: there, rotation and a negative repeat turn and
/// flip what the image says. Its size is no matter, since slopes are heights over widths of the image.
TextureImage turned_normals(TextureImage normals, const JsonNode& texture) {
  const Vec2 repeat = read_repeat(texture), sign(repeat.x < 0 ? -1 : 1, repeat.y < 0 ? -1 : 1);
  const float angle = texture.radians("rotation", 0), cosine = std::cos(angle), sine = std::sin(angle);
  if (angle == 0 && sign == Vec2(1)) return normals;
  for (const glm::u8vec4 t : normals.rgba8) normals.rgba32.push_back(Vec4(t) / 255.0f);
  normals.rgba8 = {};
  for (Vec4& t : normals.rgba32) {
    // The transpose of what set_transform() does to (u, v), v downwards.
    const float x = 2 * t.x - 1, down = 1 - 2 * t.y;
    t.x = 0.5f + 0.5f * sign.x * (cosine * x - sine * down);
    t.y = 0.5f - 0.5f * sign.y * (sine * x + cosine * down);
  }
  return normals;
}

/// The transform of KHR_texture_transform: offset * rotation * repeat applied to (u, v), the rotation
/// counter-clockwise in the image.
void set_transform(TextureSlot& slot, const JsonNode& texture) {
  const Vec2 scale = read_repeat(texture);
  Vec2 offset(0);
  if (const auto shift = texture.find("offset")) offset = shift->vec2();
  const float angle = texture.radians("rotation", 0), cosine = std::cos(angle), sine = std::sin(angle);
  slot.row_u = {cosine * scale.x, sine * scale.y, offset.x};
  slot.row_v = {-sine * scale.x, cosine * scale.y, offset.y};
}

}  // namespace

TextureSlot JsonTextures::colors(const JsonNode& name) { return slot(name, Use::colors, 0); }
TextureSlot JsonTextures::data(const JsonNode& name) { return slot(name, Use::data, 0); }
TextureSlot JsonTextures::normals(const JsonNode& name) { return slot(name, Use::normals, 0); }
TextureSlot JsonTextures::bumps(const JsonNode& name, float height) { return slot(name, Use::bumps, height); }

TextureSlot JsonTextures::slot(const JsonNode& name, Use use, float height) {
  const JsonNode texture = find_named(files_, "textures", name);
  const bool is_normals = use == Use::normals || use == Use::bumps;
  if (is_normals && read_wrap(texture) == Wrap::mirror)
    name.fail("must not be a texture with \"wrap\": \"mirror\", in which bumps would become dents");
  const std::string variant = std::to_string(static_cast<int>(use)) + " " + (is_normals ? name.text() : "") + " " +
                              std::to_string(std::bit_cast<std::uint32_t>(height));
  const auto [entry, is_new] = texture_ids_.try_emplace(variant + " " + name.text(), invalid_id);
  if (is_new) {
    const auto file = texture.find("image");
    const std::string image_key = variant + " " + texture.text("color_space", "srgb") + " " +
                                  texture.text("wrap", "repeat") + " " +
                                  (file ? referenced_file(*file).string() : "checkerboard " + name.text());
    const auto [image, is_new_image] = image_ids_.try_emplace(image_key, scene_.images.size());
    if (is_new_image) scene_.images.push_back(make_image(texture, use, height));
    const bool is_nearest = texture.has("checkerboard") || texture.text("filter", "bilinear") == "nearest";
    const Wrap wrap = read_wrap(texture);
    entry->second = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back({image->second, wrap, wrap, is_nearest ? Filter::nearest : Filter::bilinear});
  }
  TextureSlot slot;
  slot.texture = entry->second;
  set_transform(slot, texture);
  return slot;
}

TextureImage JsonTextures::make_image(const JsonNode& texture, Use use, float height) {
  const auto image = texture.find("image");
  TextureImage pixels = image ? decode(*image) : make_checkerboard(texture["checkerboard"]);
  if (use == Use::bumps) pixels = normal_map_from_heights(pixels, height, read_wrap(texture));
  if (use == Use::bumps || use == Use::normals) pixels = turned_normals(std::move(pixels), texture);
  const bool is_linear = !image || texture.text("color_space", "srgb") == "linear";
  if (use == Use::colors && is_linear) pixels = encode_linear(pixels);
  // Small files must not fill the memory with pictures that claim to be large.
  constexpr std::size_t most_bytes = std::size_t{8} << 30;
  decoded_bytes_ += pixels.bytes();
  if (decoded_bytes_ > most_bytes) texture.fail("the textures need more than 8 GiB when decoded");
  return pixels;
}

TextureImage JsonTextures::decode(const JsonNode& image) {
  const JsonFile& file = image.file();
  files_read_.push_back(referenced_file(image));
  const Bytes encoded_bytes = read_file(files_read_.back(), file.name, image.place());
  return decode_texture(encoded_bytes, image.text(), file.name, image.place());
}

Vec3 JsonTextures::largest_color(const TextureSlot& slot) {
  const std::uint32_t image = scene_.textures[slot.texture].image;
  const auto [entry, is_new] = largest_colors_.try_emplace(image);
  if (is_new) entry->second = largest_linear(scene_.images[image]);
  return entry->second;
}

}  // namespace candil
