#include "materials/extended_facets.h"

#include <cmath>

#include "core/frame.h"
#include "core/texture.h"

namespace candil {

Anisotropy anisotropy_at(const Scene& scene, const Material& material, const SurfacePoint& point) {
  if (!material.extensions || !(material.extensions->anisotropy > 0)) return {};
  const MaterialExtensions& more = *material.extensions;
  float strength = more.anisotropy;
  Vec2 direction(1, 0);
  if (more.anisotropy_texture.is_used()) {
    const Vec4 texel = sample_texture(scene, more.anisotropy_texture, point.uv, ColorSpace::linear);
    const Vec2 mapped = 2.0f * Vec2(texel) - 1.0f;
    if (mapped != Vec2(0)) direction = mapped;
    strength *= texel.z;
  }
  const float cosine = std::cos(more.anisotropy_rotation), sine = std::sin(more.anisotropy_rotation);
  direction = Vec2(cosine * direction.x - sine * direction.y, sine * direction.x + cosine * direction.y);
  // A mesh without tangents has no texture coordinates to take them from: any will do.
  const Vec3 tangent = point.tangent.w == 0 ? Frame(point.normal).tangent : Vec3(point.tangent);
  const Vec3 bitangent = (point.tangent.w < 0 ? -1.0f : 1.0f) * glm::cross(point.normal, tangent);
  return {glm::min(strength, 1.0f), direction.x * tangent + direction.y * bitangent};
}

ThinFilm film_at(const Scene& scene, const BsdfTables& tables, const Material& material, const SurfacePoint& point) {
  if (!material.extensions || !(material.extensions->iridescence > 0)) return {};
  const MaterialExtensions& more = *material.extensions;
  const auto channel = [&](const TextureSlot& slot, int index) {
    return slot.is_used() ? sample_texture(scene, slot, point.uv, ColorSpace::linear)[index] : 1.0f;
  };
  ThinFilm film;
  film.share = glm::min(more.iridescence * channel(more.iridescence_texture, 0), 1.0f);
  film.thickness = glm::mix(more.iridescence_thickness_low, more.iridescence_thickness,
                            channel(more.iridescence_thickness_texture, 1));
  film.ior = more.iridescence_ior;
  if (film.share > 0 && film.thickness > 0) film.sensitivity = &tables.iridescence()->sensitivity;
  return film;
}

ExtendedFacets extended_facets(const BsdfTables& tables, std::uint32_t material, float roughness, float strength,
                               float ior, const ThinFilm& film) {
  ExtendedFacets facets;
  facets.ggx = tables.graded_ggx();
  facets.dielectric = tables.graded_dielectric(material);
  facets.ior = ior;
  facets.film = film;
  if (film) facets.angles = &tables.iridescence()->angles;
  if (strength > 0) {
    facets.alpha = anisotropic_alpha(roughness, strength);
    facets.roughness = glm::sqrt(glm::sqrt(facets.alpha.x * facets.alpha.y));
    facets.anisotropic_ggx = tables.anisotropic_ggx();
    facets.anisotropic_dielectric = tables.anisotropic_dielectric(material);
  } else {
    facets.alpha = Vec2(sqr(roughness));
    facets.roughness = roughness;
    if (film) facets.filmed_dielectric = tables.filmed_dielectric(material);
  }
  return facets;
}

}  // namespace candil
