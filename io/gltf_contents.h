/// What a glTF file holds, whether a picture shows it or not; for `info`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace candil {

/// A part of a file that pictures lack or only approximate, and why.
struct NotHonoured {
  std::string what, reason;
};

struct GltfContents {
  std::vector<std::string> extensions_used, extensions_required;  ///< Sorted.
  std::vector<std::string> scenes, variants;                      ///< Names, which may be empty.
  std::size_t skins = 0;
  std::size_t morphed_primitives = 0, point_primitives = 0, line_primitives = 0;
};

}  // namespace candil
