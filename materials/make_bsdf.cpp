// Where a material's parameters and textures become a closure.
#include "core/emission.h"
#include "materials/bsdf.h"
#include "materials/extended_facets.h"
#include "materials/fresnel.h"
#include "materials/read_layers.h"
#include "materials/shading_normal.h"
#include "materials/texture_values.h"

namespace candil {
namespace {

bool has_specular(const Material& material) {
  switch (material.model) {
    case MaterialModel::phong:
      return !is_black(material.specular_color);
    case MaterialModel::conductor:
    case MaterialModel::specular_glossiness:
      return true;
    case MaterialModel::metallic_roughness:
      break;
  }
  if (material.extensions && material.extensions->iridescence > 0) return true;
  return material.specular > 0 || material.metallic > 0 || material.transmission > 0;
}

/// ks gives way where textures push kd + ks above 1: no channel makes energy.
PhongParameters phong_parameters(const Scene& scene, const Material& material, const SurfacePoint& point, Vec3 base) {
  const Vec3 left_over = glm::max(1.0f - base, Vec3(0));
  return {base,
          glm::min(textured_color(scene, material.specular_color, material.specular_color_texture, point), left_over),
          material.phong_exponent};
}

struct MetallicRoughness {
  float metallic, roughness;
};

MetallicRoughness metallic_roughness(const Scene& scene, const Material& material, const SurfacePoint& point) {
  if (!material.metallic_roughness_texture.is_used()) return {material.metallic, material.roughness};
  const Vec4 texel = sample_texture(scene, material.metallic_roughness_texture, point.uv, ColorSpace::linear);
  return {material.metallic * texel.z, material.roughness * texel.y};
}

/// What the surface reflects at normal incidence is taken from its diffuse base (KHR_materials_pbrSpecularGlossiness).
OpaqueParameters specular_glossiness(const Scene& scene, const Material& material, const SurfacePoint& point,
                                     Vec3 diffuse) {
  Vec4 texel(1);
  if (material.specular_color_texture.is_used()) {
    texel = sample_texture(scene, material.specular_color_texture, point.uv, ColorSpace::srgb);
  }
  const Vec3 specular = glm::min(material.specular_color * Vec3(texel), Vec3(1));
  OpaqueParameters p;
  p.roughness = 1 - (1 - material.roughness) * texel.w;
  p.base = diffuse * (1 - max_component(specular));
  p.coat_f0 = specular;
  p.coat_f90 = Vec3(1);
  return p;
}

struct Indices {
  float refracting, reflecting;
};

/// Of a wavelength, if there is one. From outside, all wavelengths are reflected like that of the mean index:
/// highlights are worth a choice of wavelength neither in noise nor in colour, since the reflectance of glass of Abbe
/// number 20 differs by 0.2 % of the light between red and blue.
Indices indices(const Material& material, bool is_front, const Wavelength& wavelength) {
  if (wavelength.nanometres == 0) return {material.ior, material.ior};
  const float ior = dispersed_ior(material.ior, material.extensions->dispersion, wavelength.nanometres);
  return {ior, is_front ? material.ior : ior};
}

void add_diffuse_transmission(const Scene& scene, const MaterialExtensions& extensions, const SurfacePoint& point,
                              OpaqueParameters& p) {
  p.diffuse_transmission =
      extensions.diffuse_transmission * channel(scene, extensions.diffuse_transmission_texture, point, 3);
  p.transmission_color = extensions.diffuse_transmission_color;
  if (!extensions.diffuse_transmission_color_texture.is_used()) return;
  p.transmission_color *=
      Vec3(sample_texture(scene, extensions.diffuse_transmission_color_texture, point.uv, ColorSpace::srgb));
}

}  // namespace

Bsdf make_bsdf(const Scene& scene, const BsdfTables& tables, const SurfacePoint& point, Vec3 wo,
               const Wavelength& wavelength) {
  const Material& material = scene.materials[point.material];
  const bool is_front = glm::dot(wo, point.normal_geometric) >= 0;
  const float side = is_front ? 1.0f : -1.0f;
  const Vec3 normal_of_sides = side * point.normal_of_sides();
  const bool is_specular = has_specular(material);
  const Vec3 mapped = mapped_normal(scene, material.normal_texture, material.normal_scale, point);
  const Vec3 normal = valid_normal(side * mapped, normal_of_sides, wo, is_specular);
  Bsdf bsdf(normal, normal_of_sides);
  const auto make_lambertian = [&](Vec3 albedo) { bsdf.kind_ = Bsdf::Kind::lambertian, bsdf.diffuse_ = albedo; };
  if (material.is_unlit) {
    make_lambertian(Vec3(0));  // it only emits
    return bsdf;
  }
  const Vec3 base(base_color(scene, material, point.uv, point.color));
  LayerParameters layers;
  if (material.extensions) layers = read_layers(scene, material, point, wo, side, normal_of_sides);
  if (!is_specular && layers.is_empty() && !material.transmits_diffusely()) {
    // Lambertian, whatever the other parameters are
    make_lambertian(base);
    return bsdf;
  }
  if (material.model == MaterialModel::phong) {
    const PhongParameters p = phong_parameters(scene, material, point, base);
    if (is_black(p.specular)) {
      make_lambertian(base);
    } else {
      bsdf.kind_ = Bsdf::Kind::phong;
      bsdf.phong_.emplace(p);
    }
    return bsdf;
  }

  const Vec3 local_o(0, 0, glm::dot(wo, normal));  // the lobes only look at the cosine here
  if (material.model == MaterialModel::specular_glossiness) {
    bsdf.opaque_.emplace(specular_glossiness(scene, material, point, base), tables.ggx(), local_o);
    return bsdf;
  }
  const auto [metallic, roughness] = metallic_roughness(scene, material, point);
  if (material.model == MaterialModel::conductor) {
    bsdf.kind_ = Bsdf::Kind::conductor;
    bsdf.conductor_.emplace(ConductorParameters{roughness, base, material.conductor_eta, material.conductor_k,
                                                tables.mean_fresnel(point.material)},
                            tables.ggx(), local_o);
    return bsdf;
  }
  const Anisotropy anisotropy = anisotropy_at(scene, material, point);
  const ThinFilm film = film_at(scene, tables, material, point);
  const bool is_extended = has_extended_facets(material);
  if (anisotropy.strength > 0) bsdf.frame_ = Frame(normal, anisotropy.direction);
  const float specular = material.specular * channel(scene, material.specular_texture, point, 3);
  const Vec3 color = textured_color(scene, material.specular_color, material.specular_color_texture, point);
  const auto [ior, reflecting_ior] = indices(material, is_front, wavelength);
  const auto facets = [&, roughness = roughness, ior = ior] {
    return extended_facets(tables, point.material, roughness, anisotropy.strength, ior, film);
  };
  const Vec3 f0 = glm::min(reflectance_of_ior(reflecting_ior) * color, Vec3(1)) * specular;
  const Vec3 f90(specular);
  const float transmission =
      material.transmission > 0 ? material.transmission * channel(scene, material.transmission_texture, point, 0) : 0;

  bsdf.dielectric_weight_ = (1 - metallic) * transmission;
  if (bsdf.dielectric_weight_ < 1) {
    // What does not transmit: metal and coated diffuse in proportion.
    const float metal = metallic / (1 - bsdf.dielectric_weight_);
    OpaqueParameters p{roughness, metal, base, f0, f90};
    if (material.transmits_diffusely()) add_diffuse_transmission(scene, *material.extensions, point, p);
    p.transmission_color *= wavelength.response;
    if (is_extended) {
      bsdf.kind_ = Bsdf::Kind::extended_opaque;
      bsdf.extended_opaque_.emplace(p, facets(), bsdf.frame_.to_local(wo));
    } else {
      bsdf.opaque_.emplace(p, tables.ggx(), local_o);
    }
  }
  if (bsdf.dielectric_weight_ > 0) {
    DielectricParameters p;
    p.roughness = roughness;
    p.ior = ior;
    p.reflecting_ior = reflecting_ior;
    p.is_thin = !material.is_volume();
    p.from_inside = !is_front && !p.is_thin;
    p.tint = base * wavelength.response;
    p.f0 = f0;
    p.f90 = f90;
    p.coat_beyond = layers.coat_beyond;
    p.table = tables.dielectric(point.material);
    if (is_extended) {
      bsdf.extended_dielectric_.emplace(p, facets(), bsdf.frame_.to_local(wo));
    } else {
      bsdf.dielectric_.emplace(p, tables.ggx(), local_o);
    }
  }
  if (!layers.is_empty()) bsdf.layers_.emplace(make_layers(layers, tables, normal, wo, bsdf.base_albedo()));
  return bsdf;
}

}  // namespace candil
