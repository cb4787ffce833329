#include "io/gltf_material_source.h"

#include "io/gltf_tinygltf.h"

namespace candil {

bool GltfProperties::has(const char* key) const { return object_.Has(key); }

void GltfProperties::read(const char* key, double low, double high, float& value) const {
  if (has(key)) value = in_range(object_.Get(key).GetNumberAsDouble(), low, high, place_ + "." + key, warnings_);
}

void GltfProperties::read(const char* key, double low, double high, Vec3& color) const {
  Vec4 padded(color, 1);
  read_channels(key, 3, low, high, padded);
  color = Vec3(padded);
}

void GltfProperties::read(const char* key, double low, double high, Vec4& color) const {
  read_channels(key, 4, low, high, color);
}

void GltfProperties::read_channels(const char* key, int count, double low, double high, Vec4& color) const {
  if (!has(key)) return;
  for (int c = 0; c < count; ++c) {
    color[c] = in_range(object_.Get(key).Get(c).GetNumberAsDouble(), low, high, place_ + "." + key, warnings_);
  }
}

void GltfProperties::read(const char* key, TextureSlot& slot) const {
  if (!has(key)) return;
  const tinygltf::Value& info = object_.Get(key);
  TextureUse use{info.Get("index").GetNumberAsInt(), 0, nullptr};
  if (info.Has("texCoord")) use.uv_set = info.Get("texCoord").GetNumberAsInt();
  const tinygltf::Value& extensions = info.Get("extensions");
  if (extensions.Has("KHR_texture_transform")) use.transform = &extensions.Get("KHR_texture_transform");
  slot = make_texture_slot(use, place_ + "." + key, textures_, warnings_);
}

void GltfProperties::read(const char* key, TextureSlot& slot, float& scale) const {
  read(key, slot);
  if (has(key) && object_.Get(key).Has("scale")) {
    scale = static_cast<float>(object_.Get(key).Get("scale").GetNumberAsDouble());
  }
}

void GltfProperties::warn(const char* key, const std::string& message) const {
  warnings_.add(place_ + "." + key, message);
}

bool MaterialSource::has_extension(const char* name) const { return material.extensions.contains(name); }

std::optional<GltfProperties> MaterialSource::extension(const char* name) const {
  const auto found = material.extensions.find(name);
  if (found == material.extensions.end()) return {};
  return std::optional<GltfProperties>(std::in_place, found->second, place + ".extensions." + name, textures, warnings);
}

}  // namespace candil
