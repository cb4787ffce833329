/// The properties that glTF animations may move, and where they are in a file's JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace candil {

/// A property that is there.
struct GltfProperty {
  enum class Kind { boolean, number, numbers };

  std::string part;                ///< The array of the root, or "extensions", that it is in.
  std::vector<std::string> steps;  ///< From the root to it.
  Kind kind = Kind::number;
  std::size_t components = 1;  ///< Numbers that it has; of morph weights: one for each target.
  bool is_rotation = false;    ///< A unit quaternion.
  bool is_weights = false;     ///< All weights of a mesh; their accessors hold scalars.
};

/// The property that a JSON pointer of KHR_animation_pointer means ("/materials/0/emissiveFactor"). Nothing for what is
/// not in the file, cannot change, or is not known to candil. Any property of the schema tables with a number, a fixed
/// count of numbers, weights or visibility can change: these tables and the specification's "Asset Object Model" list
/// the same. `root` has passed check_gltf_schema().
std::optional<GltfProperty> find_property(const nlohmann::json& root, std::string_view pointer);

/// Makes the property one that can be set: a node's matrix becomes translation, rotation and scale if one of them is
/// moved, and weights get their defaults.
void prepare_property(nlohmann::json& root, const GltfProperty& property);

/// `values` has GltfProperty::components finite numbers.
void set_property(nlohmann::json& root, const GltfProperty& property, const std::vector<double>& values);

}  // namespace candil
