#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <exception>

#include "io/error.h"
#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/image_file.h"

namespace candil {

namespace {

std::string image_place(std::size_t index, const GltfImageSource& source) {
  return indexed("images", index) + (source.buffer_view >= 0 ? ".bufferView" : ".uri");
}

/// What messages and `info` call an image: its name, else its file, else its place.
std::string image_name(std::size_t index, const GltfImageSource& source) {
  if (!source.name.empty()) return source.name;
  return source.uri.empty() || is_data_uri(source.uri) ? indexed("images", index) : source.uri;
}

/// Specification, section 5.26: values of WebGL.
Wrap to_wrap(int value, const std::string& place, Warnings& warnings) {
  switch (value) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      warnings.add(place, std::to_string(value) + " is no wrap mode, repeat is used");
      return Wrap::repeat;
  }
}

/// KHR_texture_transform: uv' = translation rotation scale uv, the rotation counter-clockwise as seen in the image (v
/// points down), as the sample models of the extension show it.
void set_transform(TextureSlot& slot, const tinygltf::Value& transform) {
  const auto pair = [&](const char* key, Vec2 fallback) {
    const tinygltf::Value& value = transform.Get(key);
    if (!value.IsArray()) return fallback;
    return Vec2(value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble());
  };
  const Vec2 offset = pair("offset", Vec2(0)), scale = pair("scale", Vec2(1));
  const double rotation = transform.Get("rotation").GetNumberAsDouble();
  const auto cosine = static_cast<float>(std::cos(rotation)), sine = static_cast<float>(std::sin(rotation));
  slot.row_u = {cosine * scale.x, sine * scale.y, offset.x};
  slot.row_v = {-sine * scale.x, cosine * scale.y, offset.y};
}

}  // namespace

std::uint32_t TextureTable::texture(int index) {
  const auto [entry, is_new] = texture_ids_.try_emplace(index, invalid_id);
  if (!is_new) return entry->second;

  const tinygltf::Model& model = document_.model();
  const tinygltf::Texture& source = model.textures[static_cast<std::size_t>(index)];
  const ImageChoice choice = images_of(source);
  const std::string place = indexed("textures", static_cast<std::size_t>(index));
  if (choice.empty()) {
    warnings_.add(place, "has no image that can be read, it is ignored");
    return invalid_id;
  }
  Texture texture;
  texture.image = image(choice);
  if (source.sampler >= 0) {
    const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(source.sampler)];
    const std::string sampler_place = indexed("samplers", static_cast<std::size_t>(source.sampler));
    texture.wrap_u = to_wrap(sampler.wrapS, sampler_place + ".wrapS", warnings_);
    texture.wrap_v = to_wrap(sampler.wrapT, sampler_place + ".wrapT", warnings_);
    // Minification needs no filter: the many samples of a pixel do its work.
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) texture.filter = Filter::nearest;
  }
  entry->second = static_cast<std::uint32_t>(scene_.textures.size());
  scene_.textures.push_back(texture);
  return entry->second;
}

std::size_t TextureTable::first_alike(std::size_t image) {
  const GltfImageSource& source = document_.images()[image];
  return first_images_.try_emplace({source.uri, source.buffer_view}, image).first->second;
}

/// A texture may have images in several containers, for readers of different abilities. Files that the extensions stand
/// for come first, as the extensions want it: those for graphics cards, then the smaller files, then PNG and JPEG.
ImageChoice TextureTable::images_of(const tinygltf::Texture& texture) {
  ImageChoice images;
  for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif", "EXT_texture_webp"}) {
    const auto extension = texture.extensions.find(name);
    if (extension == texture.extensions.end() || !extension->second.Has("source")) continue;
    images.push_back(first_alike(static_cast<std::size_t>(extension->second.Get("source").GetNumberAsInt())));
  }
  if (texture.source >= 0) images.push_back(first_alike(static_cast<std::size_t>(texture.source)));
  return images;
}

std::uint32_t TextureTable::image(const ImageChoice& choice) {
  const auto [entry, is_new] = image_ids_.try_emplace(choice, static_cast<std::uint32_t>(image_choices_.size()));
  if (is_new) image_choices_.push_back(choice);
  return entry->second;
}

TextureImage TextureTable::decode(std::size_t index, std::vector<std::filesystem::path>& files) const {
  const GltfImageSource& source = document_.images()[index];
  const std::string place = image_place(index, source), name = image_name(index, source);
  if (source.buffer_view >= 0) {
    return decode_texture(document_.buffer_view(static_cast<std::size_t>(source.buffer_view)), name, document_.name(),
                          place);
  }
  const Bytes encoded = read_reference(document_.folder(), source.uri, document_.name(), place, files);
  return decode_texture(encoded, name, document_.name(), place);
}

TextureImage TextureTable::decode_first(const ImageChoice& choice, std::vector<std::filesystem::path>& files,
                                        std::string& reason) const {
  for (std::size_t i = 0; i + 1 < choice.size(); ++i) {
    try {
      return decode(choice[i], files);
    } catch (const InputError& error) {
      if (reason.empty()) reason = error.what();
    }
  }
  return decode(choice.back(), files);
}

std::optional<TextureImage> ImageCache::take(const ImageChoice& choice) {
  const auto found = images_.extract(choice);
  if (found.empty()) return {};
  return std::move(found.mapped());
}

void ImageCache::put_back(std::vector<TextureImage> images) {
  for (std::size_t i = 0; i < std::min(images.size(), taken_.size()); ++i) images_[taken_[i]] = std::move(images[i]);
  taken_.clear();
}

std::vector<std::filesystem::path> TextureTable::decode_images() {
  const std::size_t count = image_choices_.size();
  scene_.images.resize(count);
  std::vector<std::exception_ptr> errors(count);
  std::vector<std::string> fallback_reasons(count);
  std::vector<std::vector<std::filesystem::path>> files(count);
  // One file must not fill the memory with small pictures that claim to be large.
  constexpr std::size_t most_bytes = std::size_t{8} << 30;
  std::atomic<std::size_t> decoded_bytes = 0;
  std::vector<bool> is_known(count);
  for (std::size_t i = 0; i < count && cache_ != nullptr; ++i) {
    std::optional<TextureImage> known = cache_->take(image_choices_[i]);
    if (known) scene_.images[i] = std::move(*known), is_known[i] = true;
  }
  if (cache_ != nullptr) cache_->note_taken(image_choices_);

  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (is_known[i]) return;
    try {
      if (decoded_bytes > most_bytes) document_.fail("images", "need more than 8 GiB when decoded");
      scene_.images[i] = decode_first(image_choices_[i], files[i], fallback_reasons[i]);
      decoded_bytes += scene_.images[i].bytes();
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  std::vector<std::filesystem::path> all_files;
  for (std::size_t i = 0; i < count; ++i) {
    if (errors[i]) std::rethrow_exception(errors[i]);
    all_files.insert(all_files.end(), files[i].begin(), files[i].end());
    if (!fallback_reasons[i].empty()) {
      warnings_.add(indexed("images", image_choices_[i].front()),
                    "the fallback image is used (" + fallback_reasons[i] + ")");
    }
  }
  return all_files;
}

TextureSlot make_texture_slot(const TextureUse& use, const std::string& place, TextureTable& textures,
                              Warnings& warnings) {
  TextureSlot slot;
  if (use.texture < 0) return slot;
  int uv_set = use.uv_set;
  if (use.transform != nullptr) {
    set_transform(slot, *use.transform);
    if (use.transform->Has("texCoord")) uv_set = use.transform->Get("texCoord").GetNumberAsInt();
  }
  if (uv_set > 1) {
    warnings.add(place, "uses TEXCOORD_" + std::to_string(uv_set) + ", only 0 and 1 are supported; it is ignored");
    return TextureSlot{};
  }
  slot.uv_set = static_cast<std::uint32_t>(uv_set);
  slot.texture = textures.texture(use.texture);
  return slot.is_used() ? slot : TextureSlot{};
}

}  // namespace candil
