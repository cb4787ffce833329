/// Checks a glTF document's JSON against the specification's property tables before anything else reads it, so that
/// later code meets no wrong type, no missing property and no reference to something that is not there.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace candil {

/// Throws InputError(name, place, ...) for the first wrong type, missing property, unresolved reference or integer out
/// of range. Only properties that the loader reads, or that refer to other parts, are looked at. Integers written as
/// 5.0 become integers, numbers outside of 32 bits become floating point, both for the parser that comes next.
void check_gltf_schema(nlohmann::json& root, const std::string& name);

}  // namespace candil
