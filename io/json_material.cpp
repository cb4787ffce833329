#include <array>
#include <cstdio>

#include "core/metals.h"
#include "io/default_material.h"
#include "io/json_internal.h"
#include "io/resource.h"

namespace candil {
namespace {

/// Index of refraction seen from the medium around the objects.
float relative_ior(float ior, float medium_ior) { return ior / medium_ior; }

class MaterialReader {
 public:
  MaterialReader(const JsonNode& source, JsonTextures& textures, float medium_ior)
      : source_(source), textures_(textures), medium_ior_(medium_ior) {}

  Material read() {
    const std::string type = source_["type"].text();
    material_.is_double_sided = source_.boolean("double_sided", true);
    if (type == "lambertian") read_lambertian();
    if (type == "mirror") read_phong(Vec3(0), Vec3(1));
    if (type == "plastic" || type == "phong") read_phong(Vec3(0.5f), Vec3(0.2f));
    if (type == "dielectric") read_dielectric();
    if (type == "conductor") read_conductor();
    if (type == "metallic-roughness") read_metallic_roughness();
    if (type == "emitter") read_emitter();
    read_emission();
    read_alpha();
    read_normals();
    return std::move(material_);
  }

 private:
  /// A colour and, where it has one, the slot of its texture.
  struct TexturedColor {
    Vec3 factor;
    TextureSlot slot;
  };

  TexturedColor textured(const char* key, Vec3 fallback) {
    const auto value = source_.find(key);
    if (!value) return {fallback, {}};
    if (!value->is_object()) return {value->color(), {}};
    return {value->color("factor", Vec3(1)), textures_.colors((*value)["texture"])};
  }

  void read_base_color(const char* key, Vec3 fallback) {
    const TexturedColor color = textured(key, fallback);
    material_.base_color = Vec4(color.factor, 1);
    material_.base_color_texture = color.slot;
  }

  void read_specular_color(const char* key, Vec3 fallback) {
    const TexturedColor color = textured(key, fallback);
    material_.specular_color = color.factor;
    material_.specular_color_texture = color.slot;
  }

  /// Without a specular part, the glTF model is Lambert's.
  void read_lambertian() {
    read_base_color("kd", Vec3(0.5f));
    material_.metallic = material_.specular = 0;
  }

  void read_phong(Vec3 kd, Vec3 ks) {
    material_.model = MaterialModel::phong;
    read_base_color("kd", kd);
    read_specular_color("ks", ks);
    material_.phong_exponent = source_.number("exponent", infinity);
    check_energy();
  }

  Vec3 largest(Vec3 factor, const TextureSlot& slot) const {
    return slot.is_used() ? factor * textures_.largest_color(slot) : factor;
  }

  void check_energy() const {
    const Vec3 kd = largest(Vec3(material_.base_color), material_.base_color_texture);
    const Vec3 ks = largest(material_.specular_color, material_.specular_color_texture);
    static constexpr std::array channels = {"red", "green", "blue"};
    constexpr float rounding = 1e-5f;
    for (int c = 0; c < 3; ++c) {
      if (kd[c] + ks[c] <= 1 + rounding) continue;
      std::array<char, 128> text{};
      std::snprintf(text.data(), text.size(), "kd + ks must be <= 1, is %.4g + %.4g in %s", kd[c], ks[c], channels[c]);
      source_.fail(text.data());
    }
  }

  void read_dielectric() {
    material_.metallic = 0;
    material_.roughness = source_.number("roughness", 0);
    read_volume();
    material_.transmission = 1;
    material_.ior = relative_ior(source_["ior"].number(), medium_ior_);
  }

  void read_volume() {
    material_.thickness = 1;  // above 0: a solid; rays measure the way through it
    if (const auto attenuation = source_.find("attenuation")) {
      material_.attenuation_color = (*attenuation)["color"].color();
      material_.attenuation_distance = (*attenuation)["distance"].number();
    }
  }

  void read_conductor() {
    material_.model = MaterialModel::conductor;
    read_base_color("color", Vec3(1));
    material_.roughness = source_.number("roughness", 0);
    const auto metal = source_.find("metal");
    const auto known = metal ? find_metal(metal->text()) : std::nullopt;
    material_.conductor_eta = (known ? known->eta : source_["eta"].color()) / medium_ior_;
    material_.conductor_k = (known ? known->k : source_["k"].color()) / medium_ior_;
  }

  void read_metallic_roughness() {
    read_base_color("base_color", Vec3(1));
    read_specular_color("specular_color", Vec3(1));
    material_.metallic = source_.number("metallic", 0);
    material_.roughness = source_.number("roughness", 0.5f);
    material_.specular = source_.number("specular", 1);
    material_.ior = relative_ior(source_.number("ior", 1.5f), medium_ior_);
    material_.transmission = source_.number("transmission", 0);
    if (!source_.boolean("thin", false)) read_volume();
    if (const auto texture = source_.find("metallic_roughness_texture"))
      material_.metallic_roughness_texture = textures_.data(*texture);
  }

  void read_emitter() {
    material_.base_color = Vec4(0, 0, 0, 1);
    material_.metallic = material_.specular = 0;
  }

  void read_emission() {
    const TexturedColor emission = textured("emission", Vec3(0));
    material_.emission = emission.factor;
    material_.emission_texture = emission.slot;
  }

  void read_alpha() {
    const std::string mode = source_.text("alpha_mode", "opaque");
    material_.alpha_mode = mode == "mask" ? AlphaMode::mask : mode == "blend" ? AlphaMode::blend : AlphaMode::opaque;
    material_.alpha_cutoff = source_.number("alpha_cutoff", 0.5f);
  }

  void read_normals() {
    const auto normals = source_.find("normal_map"), bumps = source_.find("bump_map");
    if (normals && bumps) source_.fail("must not have both \"normal_map\" and \"bump_map\"");
    if (normals) {
      material_.normal_texture = textures_.normals((*normals)["texture"]);
      material_.normal_scale = normals->number("scale", 1);
    }
    if (bumps) material_.normal_texture = textures_.bumps((*bumps)["texture"], (*bumps)["height"].number());
  }

  const JsonNode source_;
  JsonTextures& textures_;
  const float medium_ior_;
  Material material_;
};

}  // namespace

std::uint32_t JsonMaterials::of_object(const JsonNode& object) {
  const auto reference = object.find("material");
  if (reference && reference->is_string()) return add(find_named(files_, "materials", *reference), reference->text());
  if (reference) return add(*reference, reference->place());
  const auto [entry, is_new] = ids_.try_emplace(nullptr, static_cast<std::uint32_t>(scene_.materials.size()));
  if (is_new) scene_.materials.push_back(default_material());
  return entry->second;
}

std::uint32_t JsonMaterials::add(const JsonNode& source, const std::string& name) {
  const auto found = ids_.find(source.identity());
  if (found != ids_.end()) return found->second;
  Material material = MaterialReader(source, textures_, medium_ior_).read();
  material.name = kept_name(name);
  const auto id = static_cast<std::uint32_t>(scene_.materials.size());
  scene_.materials.push_back(std::move(material));
  ids_.emplace(source.identity(), id);
  return id;
}

void JsonMaterials::immerse(Material& material) const {
  if (material.ior > 0) material.ior = relative_ior(material.ior, medium_ior_);
}

}  // namespace candil
