/// Small glTF files, built by tests part by part.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "io/load_scene.h"

namespace candil::test {

/// Component types of the specification, section 3.6.2.2.
inline constexpr int gl_byte = 5120, gl_unsigned_byte = 5121, gl_short = 5122, gl_unsigned_short = 5123,
                     gl_unsigned_int = 5125, gl_float = 5126;

/// The arrays of a glTF file, each element written as JSON. One buffer, embedded as a data URI.
struct GltfSample {
  std::vector<std::string> accessors, views, meshes, nodes, materials, textures, images, samplers, cameras;
  std::string root;  ///< Further members of the root object, each with a comma before it.
  std::vector<std::byte> buffer;

  /// Index of a new buffer view that holds `bytes`. `members`: more of the view's JSON, beginning with a comma.
  int add_view(std::span<const std::byte> bytes, const std::string& members = "");

  /// Index of a new accessor over a view of its own. `type`: "VEC3" and so on; `members` as above.
  template <class Component>
  int add_accessor(int component_type, const std::string& type, std::size_t count, const std::vector<Component>& values,
                   const std::string& members = "") {
    return add_accessor_to_view(add_view(std::as_bytes(std::span(values))), component_type, type, count, members);
  }
  int add_accessor_to_view(int view, int component_type, const std::string& type, std::size_t count,
                           const std::string& members = "");

  /// The triangle (0 0 0), (1 0 0), (0 1 0), shown by node 0; its positions are accessor 0. `attributes` are further
  /// ones of the primitive, `members` further members, each with a comma before it.
  void add_triangle(const std::string& attributes = "", const std::string& members = "");

  std::string json() const;
};

/// Loads the text as "model.gltf" in a folder that vanishes again.
LoadedScene load_text(const std::string& text, const LoadOptions& options = {});
LoadedScene load_sample(const GltfSample& sample, const LoadOptions& options = {});

/// The message of the InputError that the text gives, without the folder; empty if it loads.
std::string load_error(const std::string& text);
std::string load_error(const GltfSample& sample);

/// A .glb of the given chunks; `length_error` is added to the length in its header.
std::string make_glb(const std::string& json, const std::string& binary, int length_error = 0);

std::string to_base64(std::span<const std::byte> bytes);

}  // namespace candil::test
