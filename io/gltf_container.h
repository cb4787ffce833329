/// The outer shell of a glTF asset: a text file, or the chunks of a binary one (specification, section 4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace candil {

/// Both parts are views into the file's bytes.
struct GltfContainer {
  std::string_view json;
  std::optional<std::span<const std::byte>> binary;  ///< The BIN chunk of a .glb.
};

/// True when the bytes begin as a binary glTF does.
bool is_glb(std::span<const std::byte> file);

/// Splits a .glb, or takes the whole file as JSON. Throws InputError(name, ...) for truncated or misordered chunks.
GltfContainer split_gltf(std::span<const std::byte> file, const std::string& name);

}  // namespace candil
