/// Counts what a glTF document holds.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "io/gltf_contents.h"

namespace candil {

/// Everything but the extensions. `root` has passed check_gltf_schema().
void count_gltf_contents(const nlohmann::json& root, GltfContents& contents);

}  // namespace candil
