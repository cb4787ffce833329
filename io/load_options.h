/// What a person chooses of a glTF file that holds more than one picture.
#pragma once

#include <string>

namespace candil {

/// Words may be the index or the name of what they choose; empty: the file's own choice.
struct LoadOptions {
  std::string scene;    ///< Of scenes[].
  std::string variant;  ///< Of KHR_materials_variants.

  bool operator==(const LoadOptions&) const = default;
};

}  // namespace candil
