/// From the extensions of a material to the layers on its closure.
#pragma once

#include <optional>

#include "core/scene.h"
#include "core/surface.h"
#include "materials/bsdf_tables.h"
#include "materials/layers.h"

namespace candil {

/// With every texture read.
struct LayerParameters {
  float coat_beyond = 0;  ///< Weight of a coat on the other side of the surface.
  std::optional<ClearcoatParameters> coat;
  std::optional<SheenParameters> sheen;

  /// Nothing on the side of wo.
  bool is_empty() const { return !coat && !sheen; }
};

/// Of a material that has extensions, seen from wo. `side`: 1 for the front, -1 for the back; `normal_of_sides` is on
/// that side. Layers that have no weight at the point are left out. Inside of a volume they lie on the other side of
/// its surface; sheen is not seen through it.
LayerParameters read_layers(const Scene& scene, const Material& material, const SurfacePoint& point, Vec3 wo,
                            float side, Vec3 normal_of_sides);

/// `normal`: the shading normal of the closure below; `base_albedo` is its albedo. Not for empty parameters.
Layers make_layers(const LayerParameters& parameters, const BsdfTables& tables, Vec3 normal, Vec3 wo, Vec3 base_albedo);

}  // namespace candil
