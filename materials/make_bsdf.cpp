// Where a material's parameters and textures become a closure.
#include "core/emission.h"
#include "core/texture.h"
#include "materials/bsdf.h"
#include "materials/extended_facets.h"
#include "materials/fresnel.h"

namespace candil {
namespace {

/// Front-side shading normal with the normal map applied (glTF 2.0, section 3.9.3).
Vec3 mapped_normal(const Scene& scene, const Material& material, const SurfacePoint& point) {
  if (!material.normal_texture.is_used() || point.tangent.w == 0) return point.normal;
  const Vec3 t = 2.0f * Vec3(sample_texture(scene, material.normal_texture, point.uv, ColorSpace::linear)) - 1.0f;
  const Vec3 tangent(point.tangent);
  const Vec3 bitangent = (point.tangent.w < 0 ? -1.0f : 1.0f) * glm::cross(point.normal, tangent);
  const Vec3 n = material.normal_scale * (t.x * tangent + t.y * bitangent) + t.z * point.normal;
  const float squared = length_squared(n);
  return squared > 0 ? n / glm::sqrt(squared) : point.normal;
}

/// A shading normal that suits `wo` and the surface, both on the same side of it: wo is above the normal, and so is the
/// mirror direction above the surface. Where interpolation or a normal map went too far, the mirror direction is lifted
/// to the horizon and the normal is put half-way between it and wo, so that specular light is bent rather than lost.
Vec3 valid_normal(Vec3 normal, Vec3 normal_of_sides, Vec3 wo, bool has_specular) {
  constexpr float least_cosine = 1e-3f;
  const float cosine = glm::dot(normal, wo);
  if (cosine < least_cosine) normal = glm::normalize(normal + (least_cosine - cosine) * wo);
  if (!has_specular) return normal;
  const Vec3 mirrored = 2 * glm::dot(normal, wo) * normal - wo;
  const float height = glm::dot(mirrored, normal_of_sides);
  const float least_height = glm::min(least_cosine, 0.5f * glm::dot(wo, normal_of_sides));
  if (height >= least_height) return normal;
  const Vec3 half = wo + glm::normalize(mirrored + (least_height - height) * normal_of_sides);
  const float squared = length_squared(half);
  return squared > 0 ? half / glm::sqrt(squared) : normal_of_sides;
}

/// The factor times the texture.
Vec3 specular_color(const Scene& scene, const Material& material, const SurfacePoint& point) {
  if (!material.specular_color_texture.is_used()) return material.specular_color;
  return material.specular_color *
         Vec3(sample_texture(scene, material.specular_color_texture, point.uv, ColorSpace::srgb));
}

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

float channel(const Scene& scene, const TextureSlot& slot, const SurfacePoint& point, int index) {
  return slot.is_used() ? sample_texture(scene, slot, point.uv, ColorSpace::linear)[index] : 1.0f;
}

/// ks gives way where textures push kd + ks above 1: no channel makes energy.
PhongParameters phong_parameters(const Scene& scene, const Material& material, const SurfacePoint& point, Vec3 base) {
  const Vec3 left_over = glm::max(1.0f - base, Vec3(0));
  return {base, glm::min(specular_color(scene, material, point), left_over), material.phong_exponent};
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
  const Vec3 normal = valid_normal(side * mapped_normal(scene, material, point), normal_of_sides, wo, is_specular);
  Bsdf bsdf(normal, normal_of_sides);
  const auto make_lambertian = [&](Vec3 albedo) { bsdf.kind_ = Bsdf::Kind::lambertian, bsdf.diffuse_ = albedo; };
  if (material.is_unlit) {
    make_lambertian(Vec3(0));  // it only emits
    return bsdf;
  }
  const Vec3 base(base_color(scene, material, point.uv, point.color));
  if (!is_specular && !material.transmits_diffusely()) {  // Lambertian, whatever the other parameters are
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
  const bool is_extended = anisotropy.strength > 0 || film;
  if (anisotropy.strength > 0) bsdf.frame_ = Frame(normal, anisotropy.direction);
  const auto facets = [&, roughness = roughness] {
    return extended_facets(tables, point.material, roughness, anisotropy.strength, film);
  };
  const float specular = material.specular * channel(scene, material.specular_texture, point, 3);
  const Vec3 color = specular_color(scene, material, point);
  const auto [ior, reflecting_ior] = indices(material, is_front, wavelength);
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
    p.table = tables.dielectric(point.material);
    if (is_extended) {
      bsdf.extended_dielectric_.emplace(p, facets(), bsdf.frame_.to_local(wo));
    } else {
      bsdf.dielectric_.emplace(p, tables.ggx(), local_o);
    }
  }
  return bsdf;
}

}  // namespace candil
