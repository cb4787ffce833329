#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"

namespace candil {

namespace {

constexpr double any_positive = std::numeric_limits<float>::max();

template <class Info>
TextureUse texture_use(const Info& info) {
  const auto transform = info.extensions.find("KHR_texture_transform");
  return {info.index, info.texCoord, transform == info.extensions.end() ? nullptr : &transform->second};
}

/// The textureInfo in an extension's object.
TextureUse texture_use(const tinygltf::Value& extension, const char* key) {
  const tinygltf::Value& info = extension.Get(key);
  if (!info.IsObject()) return {};
  TextureUse use{info.Get("index").GetNumberAsInt(), 0, nullptr};
  if (info.Has("texCoord")) use.uv_set = info.Get("texCoord").GetNumberAsInt();
  const tinygltf::Value& extensions = info.Get("extensions");
  if (extensions.Has("KHR_texture_transform")) use.transform = &extensions.Get("KHR_texture_transform");
  return use;
}

/// Reads one material; every property is looked at in the order of the specification.
class MaterialReader {
 public:
  MaterialReader(const tinygltf::Material& source, std::string place, TextureTable& textures, Warnings& warnings)
      : source_(source), place_(std::move(place)), textures_(textures), warnings_(warnings) {}

  Material read() {
    material_.name = kept_name(source_.name);
    read_metallic_roughness();
    read_surface();
    read_emission();
    read_alpha();
    read_specular();
    read_transmission();
    material_.is_unlit = extension("KHR_materials_unlit") != nullptr;
    return material_;
  }

 private:
  const tinygltf::Value* extension(const char* name) const {
    const auto found = source_.extensions.find(name);
    return found == source_.extensions.end() ? nullptr : &found->second;
  }

  std::string place(const std::string& property) const { return place_ + "." + property; }

  TextureSlot slot(const TextureUse& use, const std::string& property) {
    return make_texture_slot(use, place(property), textures_, warnings_);
  }

  float limited(double value, double low, double high, const std::string& property) {
    return in_range(value, low, high, place(property), warnings_);
  }

  /// A number of an extension's object.
  float number(const tinygltf::Value& object, const std::string& name, const char* key, double fallback, double low,
               double high) {
    if (!object.Has(key)) return static_cast<float>(fallback);
    return limited(object.Get(key).GetNumberAsDouble(), low, high, "extensions." + name + "." + key);
  }

  Vec3 color(const tinygltf::Value& object, const std::string& name, const char* key, double high) {
    Vec3 rgb(1);
    if (!object.Has(key)) return rgb;
    for (int c = 0; c < 3; ++c) {
      rgb[c] = limited(object.Get(key).Get(c).GetNumberAsDouble(), 0, high, "extensions." + name + "." + key);
    }
    return rgb;
  }

  void read_metallic_roughness() {
    const tinygltf::PbrMetallicRoughness& pbr = source_.pbrMetallicRoughness;
    const std::string group = "pbrMetallicRoughness.";
    for (std::size_t c = 0; c < 4; ++c) {
      material_.base_color[int(c)] = limited(pbr.baseColorFactor[c], 0, 1, group + "baseColorFactor");
    }
    material_.base_color_texture = slot(texture_use(pbr.baseColorTexture), group + "baseColorTexture");
    material_.metallic = limited(pbr.metallicFactor, 0, 1, group + "metallicFactor");
    material_.roughness = limited(pbr.roughnessFactor, 0, 1, group + "roughnessFactor");
    material_.metallic_roughness_texture =
        slot(texture_use(pbr.metallicRoughnessTexture), group + "metallicRoughnessTexture");
  }

  void read_surface() {
    material_.normal_texture = slot(texture_use(source_.normalTexture), "normalTexture");
    material_.normal_scale = static_cast<float>(source_.normalTexture.scale);
    material_.occlusion_texture = slot(texture_use(source_.occlusionTexture), "occlusionTexture");
    material_.occlusion_strength = limited(source_.occlusionTexture.strength, 0, 1, "occlusionTexture.strength");
    material_.is_double_sided = source_.doubleSided;
  }

  void read_emission() {
    float strength = 1;
    if (const tinygltf::Value* object = extension("KHR_materials_emissive_strength")) {
      strength = number(*object, "KHR_materials_emissive_strength", "emissiveStrength", 1, 0, 1e12);
    }
    for (std::size_t c = 0; c < source_.emissiveFactor.size(); ++c) {
      material_.emission[int(c)] = strength * limited(source_.emissiveFactor[c], 0, 1, "emissiveFactor");
    }
    material_.emission_texture = slot(texture_use(source_.emissiveTexture), "emissiveTexture");
  }

  void read_alpha() {
    if (source_.alphaMode == "MASK") {
      material_.alpha_mode = AlphaMode::mask;
    } else if (source_.alphaMode == "BLEND") {
      material_.alpha_mode = AlphaMode::blend;
    } else if (source_.alphaMode != "OPAQUE") {
      warnings_.add(place("alphaMode"), quoted_text(source_.alphaMode) + " is not known, OPAQUE is used");
    }
    material_.alpha_cutoff = limited(source_.alphaCutoff, 0, any_positive, "alphaCutoff");
  }

  void read_specular() {
    if (const tinygltf::Value* object = extension("KHR_materials_ior")) {
      const std::string name = "KHR_materials_ior";
      // Zero stands for an infinite index, everything else below 1 is out of range.
      material_.ior = number(*object, name, "ior", 1.5, 0, any_positive);
      if (material_.ior > 0 && material_.ior < 1) material_.ior = number(*object, name, "ior", 1.5, 1, any_positive);
    }
    if (const tinygltf::Value* object = extension("KHR_materials_specular")) {
      const std::string name = "KHR_materials_specular", group = "extensions." + name + ".";
      material_.specular = number(*object, name, "specularFactor", 1, 0, 1);
      material_.specular_texture = slot(texture_use(*object, "specularTexture"), group + "specularTexture");
      material_.specular_color = color(*object, name, "specularColorFactor", any_positive);
      material_.specular_color_texture =
          slot(texture_use(*object, "specularColorTexture"), group + "specularColorTexture");
    }
  }

  void read_transmission() {
    if (const tinygltf::Value* object = extension("KHR_materials_transmission")) {
      const std::string name = "KHR_materials_transmission";
      material_.transmission = number(*object, name, "transmissionFactor", 0, 0, 1);
      material_.transmission_texture =
          slot(texture_use(*object, "transmissionTexture"), "extensions." + name + ".transmissionTexture");
    }
    if (const tinygltf::Value* object = extension("KHR_materials_volume")) {
      const std::string name = "KHR_materials_volume";
      material_.thickness = number(*object, name, "thicknessFactor", 0, 0, any_positive);
      material_.attenuation_color = color(*object, name, "attenuationColor", 1);
      material_.attenuation_distance = number(*object, name, "attenuationDistance", infinity, 0, any_positive);
      if (material_.attenuation_distance == 0) {
        warnings_.add(place("extensions." + name + ".attenuationDistance"), "must be above 0, none is used");
        material_.attenuation_distance = infinity;
      }
    }
  }

  const tinygltf::Material& source_;
  const std::string place_;
  TextureTable& textures_;
  Warnings& warnings_;
  Material material_;
};

}  // namespace

std::uint32_t MaterialTable::material(int index) {
  const auto [entry, is_new] = ids_.try_emplace(index, static_cast<std::uint32_t>(scene_.materials.size()));
  if (!is_new) return entry->second;
  Material material;
  if (index >= 0) {
    const auto i = static_cast<std::size_t>(index);
    material = MaterialReader(document_.model().materials[i], indexed("materials", i), textures_, warnings_).read();
  }
  scene_.materials.push_back(std::move(material));
  return entry->second;
}

}  // namespace candil
