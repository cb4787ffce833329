/// How the parameters and textures of a material with extensions become facets.
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

/// Of a material that has_extended_facets(). `ior`: of what it refracts, which may depend on the wavelength.
ExtendedFacets extended_facets(const BsdfTables& tables, std::uint32_t material, float roughness, float strength,
                               float ior, const ThinFilm& film);

}  // namespace candil
