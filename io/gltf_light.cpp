#include <numbers>

#include "io/gltf_internal.h"
#include "io/gltf_tinygltf.h"
#include "io/placement.h"

namespace candil {

namespace {

constexpr double largest_intensity = 1e12;

/// What an intensity of the file is multiplied by to be candela or lux. Blender makes lumens of watts by 683 lm/W, the
/// efficacy of green light of 540 THz that defines the candela, and takes the watts of a point or spot light for those
/// of a whole sphere, 4 pi sr. So a lamp that was exported in each of the three ways is the same lamp again.
float light_unit(LightUnits units, PunctualKind kind) {
  constexpr double lumens_per_watt = 683;
  if (units == LightUnits::spec) return 1;
  if (units == LightUnits::compat || kind == PunctualKind::directional) return lumens_per_watt;
  return static_cast<float>(lumens_per_watt / (4 * std::numbers::pi));
}

/// KHR_lights_punctual. Nothing (and a warning) for a kind that is not known.
std::optional<PunctualLight> make_light(const tinygltf::Light& source, LightUnits units, const std::string& place,
                                        Warnings& warnings) {
  PunctualLight light;
  light.name = kept_name(source.name);
  if (source.type == "directional") {
    light.kind = PunctualKind::directional;
  } else if (source.type == "spot") {
    light.kind = PunctualKind::spot;
  } else if (source.type != "point") {
    warnings.add(place + ".type", quoted_text(source.type) + " is not known, the light is ignored");
    return {};
  }
  Vec3 color(1);
  for (std::size_t c = 0; c < source.color.size() && c < 3; ++c) {
    color[int(c)] = in_range(source.color[c], 0, largest_intensity, place + ".color", warnings);
  }
  light.intensity = color * in_range(source.intensity, 0, largest_intensity, place + ".intensity", warnings);
  light.intensity *= light_unit(units, light.kind);
  // The parser's 0 stands for no range.
  if (source.range > 0) light.range = static_cast<float>(source.range);
  if (source.range < 0) warnings.add(place + ".range", "must be above 0, it is ignored");
  if (light.kind == PunctualKind::spot) {
    constexpr double right_angle = std::numbers::pi / 2;
    light.outer_cone = in_range(source.spot.outerConeAngle, 0, right_angle, place + ".spot.outerConeAngle", warnings);
    light.inner_cone =
        in_range(source.spot.innerConeAngle, 0, light.outer_cone, place + ".spot.innerConeAngle", warnings);
  }
  return light;
}

}  // namespace

void add_lights(const GltfDocument& document, const std::vector<PlacedNode>& nodes, Scene& scene, LightUnits units,
                Warnings& warnings) {
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model().nodes[placed.node];
    const auto reference = node.extensions.find("KHR_lights_punctual");
    if (reference == node.extensions.end() || !placed.is_visible) continue;
    const auto index = static_cast<std::size_t>(reference->second.Get("light").GetNumberAsInt());
    const std::string place = "extensions.KHR_lights_punctual." + indexed("lights", index);
    std::optional<PunctualLight> light = make_light(document.model().lights[index], units, place, warnings);
    if (!light) continue;
    if (light->name.empty()) light->name = kept_name(node.name);
    light->position = placed.to_world.translation;
    // Lights shine along their -Z; a scale, even a mirroring one, only turns that as it turns any vector.
    light->direction = turned(placed.to_world, Vec3(0, 0, -1));
    if (light->kind != PunctualKind::directional && !is_within_reach(light->position)) {
      warnings.add(indexed("nodes", placed.node), "places its light farther than 1e9 m from the origin, it is ignored");
      continue;
    }
    scene.punctual_lights.push_back(std::move(*light));
  }
}

}  // namespace candil
