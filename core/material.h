/// What surfaces are made of, as plain data: textures, their use, and the parameters that become a closure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/math.h"

namespace candil {

enum class Wrap : std::uint8_t { repeat, clamp, mirror };
enum class Filter : std::uint8_t { nearest, bilinear };

/// How an image is looked up; several textures may share one image.
struct Texture {
  std::uint32_t image = 0;  ///< Into Scene::images.
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  Filter filter = Filter::bilinear;
};

/// A material's use of a texture. `row_u` and `row_v` map (u, v, 1) to the coordinates that are looked up
/// (KHR_texture_transform as an affine map).
struct TextureSlot {
  std::uint32_t texture = invalid_id;  ///< Into Scene::textures; invalid_id: no texture.
  std::uint32_t uv_set = 0;            ///< 0 or 1.
  Vec3 row_u{1, 0, 0}, row_v{0, 1, 0};

  bool is_used() const { return texture != invalid_id; }
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Which closure a material becomes; emission, alpha, sides and normal map are common to all.
enum class MaterialModel : std::uint8_t {
  metallic_roughness,  ///< glTF 2.0 with extensions; also dielectrics, smooth and rough.
  phong,      ///< base_color / pi + specular_color (n + 2) / (2 pi) cos^n, n = phong_exponent; infinite: a mirror.
  conductor,  ///< GGX of `roughness` with Fresnel's equations of conductor_eta and conductor_k, times base_color.
  /// KHR_materials_pbrSpecularGlossiness: base_color is diffuse, specular_color the reflectance at normal incidence,
  /// 1 - roughness the glossiness; specular_color_texture holds the glossiness in A.
  specular_glossiness,
};

/// What few materials have, of glTF's extensions; the defaults are theirs and change nothing. Factors multiply
/// textures.
struct MaterialExtensions {
  // KHR_materials_clearcoat: a dielectric layer of index 1.5 on top of everything.
  float clearcoat = 0, clearcoat_roughness = 0;
  TextureSlot clearcoat_texture;            ///< R.
  TextureSlot clearcoat_roughness_texture;  ///< G.
  TextureSlot clearcoat_normal_texture;     ///< Unused: the coat has the normal of the geometry.
  float clearcoat_normal_scale = 1;

  // KHR_materials_sheen: fibres on top of everything but the clear coat.
  Vec3 sheen_color{0.0f};
  TextureSlot sheen_color_texture;      ///< sRGB.
  float sheen_roughness = 0;            ///< Perceptual.
  TextureSlot sheen_roughness_texture;  ///< A.

  // KHR_materials_anisotropy: along the tangent, turned by the rotation, roughness grows with the strength.
  float anisotropy = 0;
  float anisotropy_rotation = 0;   ///< Radians, from the tangent towards the bitangent.
  TextureSlot anisotropy_texture;  ///< RG: direction, from [0, 1] to [-1, 1]; B: strength.

  // KHR_materials_iridescence: a thin film on top of the base.
  float iridescence = 0, iridescence_ior = 1.3f;
  TextureSlot iridescence_texture;                                     ///< R.
  float iridescence_thickness_low = 100, iridescence_thickness = 400;  ///< Nanometres, at texel 0 and 1.
  TextureSlot iridescence_thickness_texture;                           ///< G.

  float dispersion = 0;  ///< KHR_materials_dispersion: 20 / Abbe number, of a volume.

  // KHR_materials_diffuse_transmission: this share of the diffuse base lets light through instead of reflecting it.
  float diffuse_transmission = 0;
  TextureSlot diffuse_transmission_texture;  ///< A.
  Vec3 diffuse_transmission_color{1.0f};
  TextureSlot diffuse_transmission_color_texture;  ///< sRGB.

  // KHR_materials_volume_scatter, an experiment: what the volume scatters.
  Vec3 multiscatter_color{0.0f};  ///< Albedo after all scattering, each below 1.
  float scatter_anisotropy = 0;   ///< Henyey and Greenstein's g, in (-1, 1).
};

/// glTF 2.0 metallic-roughness with extensions; the defaults are the specification's. Factors multiply textures.
struct Material {
  std::string name;
  MaterialModel model = MaterialModel::metallic_roughness;
  Vec4 base_color{1.0f};  ///< Linear RGBA.
  TextureSlot base_color_texture;
  float metallic = 1, roughness = 1;       ///< Roughness is perceptual: alpha = roughness squared.
  TextureSlot metallic_roughness_texture;  ///< G: roughness, B: metallic.
  TextureSlot normal_texture;
  float normal_scale = 1;
  TextureSlot occlusion_texture;  ///< R. Read for `info` only: light transport computes occlusion itself.
  float occlusion_strength = 1;
  Vec3 emission{0.0f};  ///< emissiveFactor times emissiveStrength; radiance, W/(sr m2) = nit.
  TextureSlot emission_texture;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool is_double_sided = false;
  bool is_unlit = false;         ///< KHR_materials_unlit: base colour is the emitted radiance.
  float ior = 1.5f;              ///< KHR_materials_ior; 0 means an infinite one (Fresnel term 1).
  float specular = 1;            ///< KHR_materials_specular.
  TextureSlot specular_texture;  ///< A.
  Vec3 specular_color{1.0f};
  TextureSlot specular_color_texture;  ///< sRGB.
  float transmission = 0;              ///< KHR_materials_transmission.
  TextureSlot transmission_texture;    ///< R.
  float thickness = 0;                 ///< KHR_materials_volume; 0: thin-walled. Rays measure it themselves.
  Vec3 attenuation_color{1.0f};
  float attenuation_distance = infinity;  ///< Metres.
  float phong_exponent = infinity;
  Vec3 conductor_eta{0.2f}, conductor_k{3.0f};   ///< Complex index of refraction, eta - i k, for red, green, blue.
  std::optional<MaterialExtensions> extensions;  ///< None of them if absent.

  /// Whether shading may need texture coordinates.
  bool is_textured() const {
    // All bits are set in the id of no texture.
    return (base_color_texture.texture & metallic_roughness_texture.texture & normal_texture.texture &
            emission_texture.texture & specular_texture.texture & specular_color_texture.texture &
            transmission_texture.texture) != invalid_id ||
           extensions.has_value();
  }
  bool transmits_diffusely() const { return extensions && extensions->diffuse_transmission > 0; }
  /// Lets light through to the other side, diffusely or not.
  bool is_transmissive() const { return transmission > 0 || transmits_diffusely(); }
  bool is_volume() const { return thickness > 0 && is_transmissive(); }
  /// A volume that refracts each wavelength by its own index; needs `ior` above 1.
  bool is_dispersive() const {
    return thickness > 0 && transmission > 0 && ior > 1 && extensions && extensions->dispersion > 0;
  }
  /// A volume that scatters some of what it attenuates.
  bool scatters() const {
    return extensions && !is_black(extensions->multiscatter_color) && attenuation_distance < infinity;
  }
  bool is_emissive() const { return !is_black(emission) || is_unlit; }
};

/// Calls `visit` with every texture slot of `material`, a Material or const Material.
template <typename MaterialType, typename Visit>
void for_each_texture_slot(MaterialType& material, const Visit& visit) {
  visit(material.base_color_texture);
  visit(material.metallic_roughness_texture);
  visit(material.normal_texture);
  visit(material.occlusion_texture);
  visit(material.emission_texture);
  visit(material.specular_texture);
  visit(material.specular_color_texture);
  visit(material.transmission_texture);
  if (!material.extensions) return;
  visit(material.extensions->clearcoat_texture);
  visit(material.extensions->clearcoat_roughness_texture);
  visit(material.extensions->clearcoat_normal_texture);
  visit(material.extensions->sheen_color_texture);
  visit(material.extensions->sheen_roughness_texture);
  visit(material.extensions->anisotropy_texture);
  visit(material.extensions->iridescence_texture);
  visit(material.extensions->iridescence_thickness_texture);
  visit(material.extensions->diffuse_transmission_texture);
  visit(material.extensions->diffuse_transmission_color_texture);
}

}  // namespace candil
