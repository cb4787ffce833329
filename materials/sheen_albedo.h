/// How much energy the sheen of fibres returns: what lies below gets the rest.
#pragma once

#include <array>

#include "core/math.h"

namespace candil {

/// The "Charlie" sheen of colour white: fibres that stand up from the surface, more or less (Estevez and Kulla 2017,
/// "Production Friendly Microfacet Sheen BRDF"; KHR_materials_sheen). `alpha` is the square of the perceptual
/// roughness. Cosines are positive.
struct Charlie {
  /// Fibres that stand straighter would be seen at the very outline of things only, and cost energy to be tabulated.
  static constexpr float min_roughness = 0.07f;

  /// Density of facet normals with that sine of the angle to the surface's normal.
  static float distribution(float sine2, float alpha);
  /// Smith's lambda as fitted by the authors.
  static float lambda(float cosine, float alpha);
  /// Cosine for both lambda and the division by it; the limit of grazing directions, towards which it has no albedo.
  static float bounded(float cosine) { return glm::max(cosine, 1e-4f); }
};

/// Directional albedo over roughness and cosine, interpolated. More than 1 for small roughness at grazing angles: the
/// model makes energy there.
class SheenAlbedo {
 public:
  SheenAlbedo();
  /// Within 0.4 % of itself or of 1, whichever is more, of the true albedo.
  float directional(float roughness, float cosine) const;

 private:
  static constexpr int roughness_count = 32, cosine_count = 64;
  std::array<std::array<float, cosine_count>, roughness_count> values_;
};

}  // namespace candil
