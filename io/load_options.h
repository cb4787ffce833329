/// What a person chooses of a glTF file that holds more than one picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace candil {

/// Words may be the index or the name of what they choose; empty: the file's own choice,
/// or the first one.
struct LoadOptions {
  std::string scene;                     ///< Of scenes[].
  std::string variant;                   ///< Of KHR_materials_variants.
  std::string animation;                 ///< Of animations[], or "all"; see is_animated().
  std::optional<double> at;              ///< The time in the animation, seconds; 0 if only the animation is chosen.
  std::vector<std::string> experiments;  ///< Extensions to have although they are experimental, by name.

  /// Otherwise the file is shown in its rest pose: as it stores its nodes, weights and materials.
  bool is_animated() const { return at.has_value() || !animation.empty(); }

  bool operator==(const LoadOptions&) const = default;
};

}  // namespace candil
