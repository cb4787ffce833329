/// How much energy a rough interface returns in its first scattering: what is missing to 1 is what multiple scattering
/// between the facets must give back (Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks").
#pragma once

#include <array>

#include <cmath>

#include "core/math.h"
#include "materials/grid_position.h"

namespace candil {

/// Values over roughness in [0, 1] and the cosine in [0, 1], linear in their square roots: at grazing angles an albedo
/// changes within a cosine of the squared roughness.
struct AlbedoGrid {
  static constexpr int roughness_count = 32, cosine_count = 32;
  std::array<std::array<float, cosine_count>, roughness_count> values{};

  static GridPosition roughness_position(float roughness) { return {root(roughness), roughness_count}; }
  struct Position {
    GridPosition roughness, cosine;
    Position(float r, float c) : roughness(roughness_position(r)), cosine(root(c), cosine_count) {}
  };
  float lookup(const Position& position) const;

 private:
  static float root(float x) { return glm::sqrt(glm::max(x, 0.0f)); }
};

/// A reflecting GGX interface under Schlick's Fresnel term: single-scattering albedo = f0 scale + f90 bias.
class GgxAlbedo {
 public:
  GgxAlbedo();
  /// Made when it is first asked for: it depends on no scene.
  static const GgxAlbedo& shared();

  struct Split {
    float scale, bias;
    float total() const { return scale + bias; }  ///< Albedo where Fresnel's term is 1 everywhere.
  };
  /// Directional albedo for a direction with that cosine.
  Split directional(float roughness, float cosine) const {
    const AlbedoGrid::Position position(roughness, cosine);
    return {scale_.lookup(position), bias_.lookup(position)};
  }
  /// Its mean over the cosine-weighted hemisphere.
  Split average(float roughness) const;

 private:
  AlbedoGrid scale_, bias_;
  std::array<Split, AlbedoGrid::roughness_count> average_;
};

/// Colour of light that was reflected at least twice between facets: the geometric series of Kulla and Conty 2017.
/// `mean_fresnel` and `mean_albedo` (of facets that reflect everything) are means over the cosine-weighted hemisphere.
inline Vec3 multiple_scattering_color(Vec3 mean_fresnel, float mean_albedo) {
  return mean_fresnel * mean_fresnel * mean_albedo / (1.0f - mean_fresnel * (1 - mean_albedo));
}

/// Albedo under a Fresnel term that is not Schlick's: what it deviates from his curve is interpolated linearly between
/// nodes, cosines at facets from 0 to 1, at both ends of which it is 0. This tells how much light is reflected by
/// facets near each of the other nodes.
class FacetAngles {
 public:
  static constexpr int node_count = 8;
  using Nodes = std::array<float, node_count>;
  static float cosine(int node) { return static_cast<float>(node + 1) / (node_count + 1); }

  FacetAngles();
  Nodes directional(float roughness, float cosine) const;
  /// Its mean over the cosine-weighted hemisphere.
  Nodes average(float roughness) const;
  /// For a smooth interface: the cosine-weighted mean over the hemisphere of what is linear between the nodes is the
  /// sum of these times its values there: 2 * integral of mu times the hat function of the node.
  static float mean_weight(int node) { return 2 * cosine(node) / (node_count + 1); }

 private:
  std::array<AlbedoGrid, node_count> grids_;
  std::array<std::array<float, AlbedoGrid::roughness_count>, node_count> averages_{};
};

/// A rough dielectric that reflects and refracts, seen from either side: reflected plus transmitted energy.
class DielectricAlbedo {
 public:
  /// `ior` > 0, not 1.
  explicit DielectricAlbedo(float ior);

  /// `from_inside`: the direction is behind the front, in the medium.
  float directional(float roughness, float cosine, bool from_inside) const {
    return sides_[from_inside].lookup({roughness, cosine});
  }
  float average(float roughness, bool from_inside) const;
  float ior() const { return ior_; }

 private:
  float ior_;
  std::array<AlbedoGrid, 2> sides_;
  std::array<std::array<float, AlbedoGrid::roughness_count>, 2> averages_;
};

/// What DielectricAlbedo changes by where facets have another reflectance than Fresnel's. The difference is
/// interpolated linearly between nodes, cosines from 0, where it is 0, to 1 in the medium of the lesser index: in the
/// other one, light beyond the critical angle is reflected anyway. Both sides of a facet have the same reflectance at
/// angles that refraction makes correspond. This tells how much less energy returns by a greater
/// reflectance near each node: facets hide what they reflect and what they refract from each other in different
/// measure.
class FilmedDielectricAlbedo {
 public:
  static constexpr int node_count = 8;
  using Nodes = std::array<float, node_count>;
  static float cosine(int node) { return static_cast<float>(node + 1) / node_count; }
  /// Of a facet h that is visible from wo. `eta`: index beyond it over the one before it.
  template <typename Alpha>
  static Nodes of_facet(Vec3 wo, Vec3 h, Alpha alpha, float eta);

  explicit FilmedDielectricAlbedo(float ior);

  Nodes directional(float roughness, float cosine, bool from_inside) const;
  /// Its mean over the cosine-weighted hemisphere.
  Nodes average(float roughness, bool from_inside) const;
  float ior() const { return ior_; }

 private:
  float ior_;
  std::array<std::array<AlbedoGrid, node_count>, 2> sides_;
  std::array<std::array<std::array<float, AlbedoGrid::roughness_count>, node_count>, 2> averages_;
};

}  // namespace candil
