/// Energy that an anisotropic GGX interface returns in its first scattering, as ggx_albedo.h for isotropic ones.
///
/// It depends on four numbers: both roughnesses and the direction. Smith's masking sees the direction only by its
/// projected roughness times the tangent of its angle, the slope at which facets hide each other; tabulated over this
/// slope, over where the projected roughness lies between the two, and over these, the albedo of what reflects
/// everything is so smooth that a coarse grid will do. Fresnel's term depends on the direction otherwise, and smoothly:
/// it is tabulated as a factor, in coordinates of its own (anisotropic_grid.h). A white furnace loses 1 % at most, and
/// gains 0.5 % (tests/materials/anisotropy_test.cpp).
#pragma once

#include <memory>
#include <vector>

#include "materials/anisotropic_grid.h"
#include "materials/ggx_albedo.h"

namespace candil {

/// Squared perceptual roughness along x and y: along x it grows with the strength (KHR_materials_anisotropy).
Vec2 anisotropic_alpha(float roughness, float strength);

// In what follows, `alpha` is from anisotropic_alpha(), and directions are on either side of the surface.

/// GgxAlbedo and FacetAngles of an anisotropic interface.
class AnisotropicAlbedo {
 public:
  /// The same for all scenes; made when it is asked for first. `has_films`: with the nodes of FacetAngles.
  static const AnisotropicAlbedo& shared(bool has_films);

  /// Where Fresnel's term is 1 everywhere.
  float total(Vec2 alpha, Vec3 w) const;
  GgxAlbedo::Split directional(Vec2 alpha, Vec3 w) const;
  GgxAlbedo::Split average(Vec2 alpha) const;
  FacetAngles::Nodes directional_nodes(Vec2 alpha, Vec3 w) const;
  FacetAngles::Nodes average_nodes(Vec2 alpha) const { return nodes_->means(alpha); }

 private:
  explicit AnisotropicAlbedo(bool has_films);

  static constexpr int azimuth_count = 10, slope_count = 24, cell_count = azimuth_count * slope_count;
  using Rows = AnisotropicRows<16, 14>;
  struct Nodes {
    AnisotropicGrid<FacetAngles::node_count, 6, 6> shares;  // of the total
    AnisotropicMeans<FacetAngles::node_count> means;
  };

  void fill_totals();

  std::vector<float> roots_;            // of what is lost, by row, azimuth, slope
  AnisotropicGrid<1, 18, 12> bias_;     // as a share of the total, beyond that of a common facet
  AnisotropicMeans<2, true> averages_;  // lost, bias
  std::unique_ptr<Nodes> nodes_;
};

/// DielectricAlbedo and FilmedDielectricAlbedo of an anisotropic interface.
class AnisotropicDielectricAlbedo {
 public:
  /// `reflecting` must outlive it.
  AnisotropicDielectricAlbedo(float ior, bool has_films, bool may_be_reshaped, const AnisotropicAlbedo& reflecting);

  float directional(Vec2 alpha, Vec3 w, bool from_inside) const {
    return 1 - sides_[from_inside].lost(alpha, w, *reflecting_);
  }
  float average(Vec2 alpha, bool from_inside) const { return 1 - sides_[from_inside].mean_lost(alpha)[0]; }
  FilmedDielectricAlbedo::Nodes directional_nodes(Vec2 alpha, Vec3 w, bool from_inside) const {
    return sides_[from_inside].nodes->directional(alpha, w);
  }
  FilmedDielectricAlbedo::Nodes average_nodes(Vec2 alpha, bool from_inside) const {
    return sides_[from_inside].nodes->means(alpha);
  }
  /// Of ReshapedDielectric, what is for facets.
  Vec2 directional_reshaped(Vec2 alpha, Vec3 w, bool from_inside) const {
    const auto [by_constant, by_exact] = sides_[from_inside].reshaped->directional(alpha, w);
    return {by_constant, by_exact};
  }
  Vec2 average_reshaped(Vec2 alpha, bool from_inside) const {
    const auto [by_constant, by_exact] = sides_[from_inside].reshaped->means(alpha);
    return {by_constant, by_exact};
  }
  float ior() const { return ior_; }

 private:
  struct Nodes {
    AnisotropicGrid<FilmedDielectricAlbedo::node_count, 6, 6> directional;
    AnisotropicMeans<FilmedDielectricAlbedo::node_count> means;
  };
  struct Reshaped {
    AnisotropicGrid<2, 18, 10, 21> directional;
    AnisotropicMeans<2> means;
  };
  struct Side {
    Side(float eta, bool has_films, bool may_be_reshaped, const AnisotropicAlbedo& reflecting);
    float lost(Vec2 alpha, Vec3 w, const AnisotropicAlbedo& reflecting) const;

    AnisotropicGrid<2, 11, 10, 21>
        shares;  // the factor of what is lost if everything is reflected, and what is lost besides
    AnisotropicMeans<1, true> mean_lost;
    std::unique_ptr<Nodes> nodes;
    std::unique_ptr<Reshaped> reshaped;
  };

  float ior_;
  const AnisotropicAlbedo* reflecting_;
  std::array<Side, 2> sides_;  // from outside, from inside
};

}  // namespace candil
