/// What a person chooses of a glTF file that holds more than one picture, or can be understood in more than one way.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace candil {

/// What the intensities of KHR_lights_punctual are, by the names of Blender's exporter and importer.
enum class LightUnits {
  spec,    ///< As the extension wants: candela (point, spot) and lux (directional).
  compat,  ///< "Unitless": W/sr and W/m2, which the exporter did not turn into lumens.
  raw,     ///< Blender's own numbers: the W of a point or spot light's whole sphere, the W/m2 of a sun.
};

/// Words may be the index or the name of what they choose; empty: the file's own choice,
/// or the first one.
struct LoadOptions {
  std::string scene;         ///< Of scenes[].
  std::string variant;       ///< Of KHR_materials_variants.
  std::string animation;     ///< Of animations[], or "all"; see is_animated().
  std::optional<double> at;  ///< The time in the animation, seconds; 0 if only the animation is chosen.
  LightUnits light_units = LightUnits::spec;
  float point_radius = 0;                ///< Of primitives of points and lines, metres; 0: they are not shown.
  std::vector<std::string> experiments;  ///< Extensions to have although they are experimental, by name.

  /// Otherwise the file is shown in its rest pose: as it stores its nodes, weights and materials.
  bool is_animated() const { return at.has_value() || !animation.empty(); }

  bool operator==(const LoadOptions&) const = default;
};

}  // namespace candil
