#include "io/gltf_material_source.h"
#include "io/gltf_tinygltf.h"

namespace candil {

namespace {

template <class Info>
TextureUse texture_use(const Info& info) {
  const auto transform = info.extensions.find("KHR_texture_transform");
  return {info.index, info.texCoord, transform == info.extensions.end() ? nullptr : &transform->second};
}

/// Reads the core properties of a material in the order of the specification.
class MaterialReader {
 public:
  explicit MaterialReader(const MaterialSource& source) : source_(source), core_(source.material) {}

  Material read() {
    material_.name = kept_name(core_.name);
    read_metallic_roughness();
    read_surface();
    read_emission();
    read_alpha();
    read_material_extensions(source_, material_);
    return std::move(material_);
  }

 private:
  std::string place(const std::string& property) const { return source_.place + "." + property; }

  TextureSlot slot(const TextureUse& use, const std::string& property) {
    return make_texture_slot(use, place(property), source_.textures, source_.warnings);
  }

  float limited(double value, double low, double high, const std::string& property) {
    return in_range(value, low, high, place(property), source_.warnings);
  }

  void read_metallic_roughness() {
    const tinygltf::PbrMetallicRoughness& pbr = core_.pbrMetallicRoughness;
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
    material_.normal_texture = slot(texture_use(core_.normalTexture), "normalTexture");
    material_.normal_scale = static_cast<float>(core_.normalTexture.scale);
    material_.occlusion_texture = slot(texture_use(core_.occlusionTexture), "occlusionTexture");
    material_.occlusion_strength = limited(core_.occlusionTexture.strength, 0, 1, "occlusionTexture.strength");
    material_.is_double_sided = core_.doubleSided;
  }

  void read_emission() {
    float strength = 1;
    if (const auto properties = source_.extension("KHR_materials_emissive_strength")) {
      properties->read("emissiveStrength", 0, 1e12, strength);
    }
    for (std::size_t c = 0; c < core_.emissiveFactor.size(); ++c) {
      material_.emission[int(c)] = strength * limited(core_.emissiveFactor[c], 0, 1, "emissiveFactor");
    }
    material_.emission_texture = slot(texture_use(core_.emissiveTexture), "emissiveTexture");
  }

  void read_alpha() {
    if (core_.alphaMode == "MASK") {
      material_.alpha_mode = AlphaMode::mask;
    } else if (core_.alphaMode == "BLEND") {
      material_.alpha_mode = AlphaMode::blend;
    } else if (core_.alphaMode != "OPAQUE") {
      source_.warnings.add(place("alphaMode"), quoted_text(core_.alphaMode) + " is not known, OPAQUE is used");
    }
    material_.alpha_cutoff = limited(core_.alphaCutoff, 0, any_positive, "alphaCutoff");
  }

  const MaterialSource& source_;
  const tinygltf::Material& core_;
  Material material_;
};

}  // namespace

std::uint32_t MaterialTable::material(const tinygltf::Primitive& primitive, const std::string& place) {
  return material(material_of_variant(primitive, variant_, place, warnings_));
}

std::uint32_t MaterialTable::material(int index) {
  const auto [entry, is_new] = ids_.try_emplace(index, static_cast<std::uint32_t>(scene_.materials.size()));
  if (!is_new) return entry->second;
  Material material;
  if (index >= 0) {
    const auto i = static_cast<std::size_t>(index);
    const MaterialSource source{document_.model().materials[i], indexed("materials", i), textures_, warnings_};
    material = MaterialReader(source).read();
  }
  scene_.materials.push_back(std::move(material));
  return entry->second;
}

}  // namespace candil
