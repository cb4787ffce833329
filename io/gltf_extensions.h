/// Which glTF extensions candil has.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace candil {

/// Read and rendered.
bool is_supported_gltf_extension(std::string_view extension);

/// Not read, but may be ignored even when a file requires it, since by its own text it cannot change a still image of
/// the default state: metadata, interaction, and variants, whose text makes the primitives' own materials the default.
bool is_harmless_gltf_extension(std::string_view extension);

/// Throws InputError(name, "extensionsRequired", ...) that names every extension that is neither of the two.
void refuse_unknown_gltf_extensions(const std::vector<std::string>& required, const std::string& name);

}  // namespace candil
