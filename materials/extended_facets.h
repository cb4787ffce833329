/// How a material's parameters and textures for KHR_materials_anisotropy and KHR_materials_iridescence become facets.
#pragma once

#include <optional>

#include "core/surface.h"
#include "materials/bsdf_tables.h"
#include "materials/facets.h"

namespace candil {

struct Anisotropy {
  float strength = 0;    ///< In [0, 1]; 0: there is none.
  Vec3 direction{0.0f};  ///< World space, of greater roughness; near the plane of the surface.
};

Anisotropy anisotropy_at(const Scene& scene, const Material& material, const SurfacePoint& point);

ThinFilm film_at(const Scene& scene, const BsdfTables& tables, const Material& material, const SurfacePoint& point);

/// To be called only if one of the extensions has an effect.
ExtendedFacets extended_facets(const BsdfTables& tables, std::uint32_t material, float roughness, float strength,
                               const ThinFilm& film);

}  // namespace candil
