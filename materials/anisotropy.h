/// Energy that an anisotropic GGX interface returns in its first scattering, as ggx_albedo.h for isotropic ones.
///
/// It depends on four numbers: both roughnesses and the direction. Smith's masking sees the direction only by its
/// projected roughness times the tangent of its angle, the slope at which facets hide each other; tabulated over this
/// slope, over where the projected roughness lies between the two, and over these, the albedo is so smooth that a
/// coarse grid will do: a white furnace stays white within 1 %, within 2 % for a coated base and 7 % for glass where
/// the strength is 1 (tests/materials/anisotropy_test.cpp).
#pragma once

#include <vector>

#include "materials/ggx_albedo.h"

namespace candil {

/// Squared perceptual roughness along x and y: along x it grows with the strength (KHR_materials_anisotropy).
Vec2 anisotropic_alpha(float roughness, float strength);

/// Values over anisotropic_alpha() and the upper hemisphere, linearly interpolated, with their cosine-weighted means.
class AnisotropicGrid {
 public:
  /// Mean of `value(wo, h, alpha)` over visible facet normals h of each cell.
  template <typename Value>
  void fill(const Value& value);
  /// `alpha` from anisotropic_alpha(); w.z > 0 or < 0, all the same.
  Vec2 directional(Vec2 alpha, Vec3 w) const;
  Vec2 average(Vec2 alpha) const;

 private:
  static constexpr int roughness_count = 12, strength_count = 16, azimuth_count = 8, slope_count = 16;
  struct Rows;
  static std::size_t row(int roughness, int strength) {
    return static_cast<std::size_t>(roughness) * strength_count + static_cast<std::size_t>(strength);
  }

  std::vector<Vec2> values_;  // by roughness, strength, azimuth, slope
  std::vector<Vec2> averages_;
};

/// An anisotropic interface that reflects everything.
class AnisotropicAlbedo {
 public:
  AnisotropicAlbedo();
  float directional(Vec2 alpha, Vec3 w) const { return grid_.directional(alpha, w).x; }
  float average(Vec2 alpha) const { return grid_.average(alpha).x; }

 private:
  AnisotropicGrid grid_;
};

/// DielectricAlbedo of an anisotropic interface.
class AnisotropicDielectricAlbedo {
 public:
  explicit AnisotropicDielectricAlbedo(float ior);
  float directional(Vec2 alpha, Vec3 w, bool from_inside) const { return grid_.directional(alpha, w)[from_inside]; }
  float average(Vec2 alpha, bool from_inside) const { return grid_.average(alpha)[from_inside]; }
  float ior() const { return ior_; }

 private:
  float ior_;
  AnisotropicGrid grid_;  // from outside, from inside
};

}  // namespace candil
