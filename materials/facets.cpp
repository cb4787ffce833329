#include "materials/facets.h"

namespace candil {
namespace {

/// Facets of the mean roughness stand for anisotropic ones, with as much light in total.
FacetAngles::Nodes scaled(FacetAngles::Nodes nodes, float total, float isotropic_total) {
  for (float& share : nodes) share *= total / glm::max(1e-6f, isotropic_total);
  return nodes;
}

}  // namespace

FacetAngles::Nodes ExtendedFacets::directional_nodes(Vec3 w, GgxAlbedo::Split single) const {
  const FacetAngles::Nodes nodes = angles->directional(roughness, w.z);
  return anisotropic_ggx ? scaled(nodes, single.total(), ggx->directional(roughness, w.z).total()) : nodes;
}

FacetAngles::Nodes ExtendedFacets::average_nodes(GgxAlbedo::Split mean) const {
  const FacetAngles::Nodes nodes = angles->average(roughness);
  return anisotropic_ggx ? scaled(nodes, mean.total(), ggx->average(roughness).total()) : nodes;
}

}  // namespace candil
