/// The tables of ggx_albedo.h for materials with extensions: fine enough that what lies below a layer gets what the
/// layer leaves over, also at grazing angles and on all but smooth surfaces.
///
/// A facet's neighbours hide it where the cosine falls to about alpha, which is the perceptual roughness squared: over
/// the square roots of both, that edge has the same shape everywhere, and few points will do. Up to 89.5 degrees an
/// albedo is off by 0.5 % at most, below 86 degrees by 0.2 % (evenly spaced tables: 10 % and 0.5 %).
#pragma once

#include <array>
#include <vector>

#include "materials/ggx_albedo.h"
#include "materials/grid_position.h"

namespace candil {

/// Between two values of a table.
template <typename Value>
Value interpolated(const Value& low, const Value& high, float fraction) {
  return glm::mix(low, high, fraction);
}
inline glm::mat2x3 interpolated(const glm::mat2x3& low, const glm::mat2x3& high, float fraction) {
  return low * (1 - fraction) + high * fraction;
}

/// Values over roughness and cosine in [0, 1], linear in their square roots, and their means over the cosine-weighted
/// hemisphere.
template <typename Value>
class GradedGrid {
 public:
  /// Mean of `value(wo, h, alpha)` over visible facet normals h of each cell.
  template <typename Function>
  void fill(const Function& value);

  Value directional(float roughness, float cosine) const {
    const GridPosition r(root(roughness), roughness_count), c(root(cosine), cosine_count);
    const auto row = [&](int i) { return interpolated(values_[i][c.index], values_[i][c.index + 1], c.fraction); };
    return interpolated(row(r.index), row(r.index + 1), r.fraction);
  }
  Value average(float roughness) const {
    const GridPosition r(root(roughness), roughness_count);
    return interpolated(averages_[r.index], averages_[r.index + 1], r.fraction);
  }

 private:
  static constexpr int roughness_count = 32, cosine_count = 64;
  static float root(float x) { return glm::sqrt(glm::max(x, 0.0f)); }

  std::array<std::array<Value, cosine_count>, roughness_count> values_;
  std::array<Value, roughness_count> averages_;
};

/// GgxAlbedo on such a grid.
class GradedGgxAlbedo {
 public:
  /// The same for all scenes; made when it is asked for first.
  static const GradedGgxAlbedo& shared();

  GgxAlbedo::Split directional(float roughness, float cosine) const {
    return split(grid_.directional(roughness, cosine));
  }
  GgxAlbedo::Split average(float roughness) const { return split(grid_.average(roughness)); }

 private:
  GradedGgxAlbedo();
  static GgxAlbedo::Split split(Vec2 value) { return {value.x, value.y}; }

  GradedGrid<Vec2> grid_;  // scale, bias
};

/// The indices of refraction of a material, 0 < least <= mean <= greatest, all the same but where it disperses light.
/// From outside, all wavelengths are reflected like that of the mean index.
struct DielectricRange {
  float least_ior, mean_ior, greatest_ior;
  bool may_be_coated;
  bool may_be_reshaped;  ///< By KHR_materials_specular.

  bool operator==(const DielectricRange&) const = default;
};

/// What energy a dielectric keeps less where facets reflect not F, Fresnel's reflectance, but constant + factor F (but
/// everything under total internal reflection): constant x by_constant + (factor - 1) x by_exact, per channel. A coat
/// beyond it adds by_coat (1 - constant - factor) + factor x what it adds to F.
struct ReshapedDielectric {
  float by_constant, by_exact;
  float by_coat;  ///< Seen from inside.
};

/// DielectricAlbedo on such grids, for a range of indices of refraction.
class GradedDielectricAlbedo {
 public:
  struct Energy {
    float kept;     ///< Reflected plus transmitted, in the first scattering.
    float by_coat;  ///< Seen from inside: what a coat of weight 1 beyond the interface adds to it; may be negative.
  };

  explicit GradedDielectricAlbedo(const DielectricRange& range);

  /// `from_inside`: the direction is behind the front, in the medium.
  Energy directional(float ior, float roughness, float cosine, bool from_inside) const {
    return of_side(at(grids_, ior, [&](const Grid& grid) { return grid.directional(roughness, cosine); }), from_inside);
  }
  Energy average(float ior, float roughness, bool from_inside) const {
    return of_side(at(grids_, ior, [&](const Grid& grid) { return grid.average(roughness); }), from_inside);
  }
  /// If range().may_be_reshaped.
  ReshapedDielectric directional_reshaped(float ior, float roughness, float cosine, bool from_inside) const {
    const auto lookup = [&](const ReshapedGrid& grid) { return grid.directional(roughness, cosine); };
    return reshaped_of_side(at(reshaped_, ior, lookup), from_inside);
  }
  ReshapedDielectric average_reshaped(float ior, float roughness, bool from_inside) const {
    return reshaped_of_side(at(reshaped_, ior, [&](const ReshapedGrid& grid) { return grid.average(roughness); }),
                            from_inside);
  }
  const DielectricRange& range() const { return range_; }

 private:
  using Grid = GradedGrid<Vec3>;                 // from outside, from inside, by a coat
  using ReshapedGrid = GradedGrid<glm::mat2x3>;  // a column each, from outside and from inside

  static Energy of_side(Vec3 value, bool from_inside) {
    return from_inside ? Energy{value.y, value.z} : Energy{value.x, 0};
  }
  static ReshapedDielectric reshaped_of_side(const glm::mat2x3& value, bool from_inside) {
    const Vec3 side = value[from_inside ? 1 : 0];
    return {side.x, side.y, side.z};
  }
  template <typename Value, typename Lookup>
  Value at(const std::vector<GradedGrid<Value>>& grids, float ior, const Lookup& lookup) const {
    if (grids.size() == 1) return lookup(grids[0]);
    const GridPosition i((ior - range_.least_ior) / (range_.greatest_ior - range_.least_ior),
                         static_cast<int>(grids.size()));
    const auto index = static_cast<std::size_t>(i.index);
    return interpolated(lookup(grids[index]), lookup(grids[index + 1]), i.fraction);
  }

  DielectricRange range_;
  // At evenly spaced indices of refraction.
  std::vector<Grid> grids_;
  std::vector<ReshapedGrid> reshaped_;  // may be empty
};

}  // namespace candil
