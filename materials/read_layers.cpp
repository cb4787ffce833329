#include "materials/read_layers.h"

#include "materials/shading_normal.h"
#include "materials/texture_values.h"

namespace candil {
namespace {

float coat_weight(const Scene& scene, const MaterialExtensions& material, const SurfacePoint& point) {
  if (material.clearcoat == 0) return 0;
  return glm::clamp(material.clearcoat * channel(scene, material.clearcoat_texture, point, 0), 0.0f, 1.0f);
}

std::optional<ClearcoatParameters> read_coat(const Scene& scene, const MaterialExtensions& material,
                                             const SurfacePoint& point, Vec3 wo, float side, Vec3 normal_of_sides) {
  const float weight = coat_weight(scene, material, point);
  if (weight == 0) return std::nullopt;
  const Vec3 normal = mapped_normal(scene, material.clearcoat_normal_texture, material.clearcoat_normal_scale, point);
  return ClearcoatParameters{
      weight, material.clearcoat_roughness * channel(scene, material.clearcoat_roughness_texture, point, 1),
      valid_normal(side * normal, normal_of_sides, wo, true)};
}

std::optional<SheenParameters> read_sheen(const Scene& scene, const MaterialExtensions& material,
                                          const SurfacePoint& point) {
  if (is_black(material.sheen_color)) return std::nullopt;
  const Vec3 color = textured_color(scene, material.sheen_color, material.sheen_color_texture, point);
  if (is_black(color)) return std::nullopt;
  return SheenParameters{glm::clamp(color, 0.0f, 1.0f),
                         material.sheen_roughness * channel(scene, material.sheen_roughness_texture, point, 3)};
}

}  // namespace

LayerParameters read_layers(const Scene& scene, const Material& material, const SurfacePoint& point, Vec3 wo,
                            float side, Vec3 normal_of_sides) {
  LayerParameters layers;
  if (side < 0 && material.is_volume()) {
    layers.coat_beyond = coat_weight(scene, *material.extensions, point);
  } else {
    layers.coat = read_coat(scene, *material.extensions, point, wo, side, normal_of_sides);
    layers.sheen = read_sheen(scene, *material.extensions, point);
  }
  return layers;
}

Layers make_layers(const LayerParameters& p, const BsdfTables& tables, Vec3 normal, Vec3 wo, Vec3 base_albedo) {
  std::optional<ClearcoatLobe> coat;
  if (p.coat) coat.emplace(*p.coat, *tables.graded_ggx(), wo);
  std::optional<SheenLobe> sheen;
  if (p.sheen) sheen.emplace(*p.sheen, tables.sheen(), normal, wo);
  return {coat, sheen, base_albedo};
}

}  // namespace candil
