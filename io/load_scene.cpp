#include "io/load_scene.h"

#include <array>
#include <fstream>
#include <string_view>

#include "io/error.h"
#include "io/gltf_internal.h"
#include "io/json_internal.h"

namespace candil {

namespace {

/// True when the file begins as binary glTF or, after blanks and a byte order mark, as a JSON object.
bool looks_like_gltf(const std::filesystem::path& path) {
  std::array<char, 256> start{};
  std::ifstream stream(path, std::ios::binary);
  stream.read(start.data(), start.size());
  std::string_view text(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (text.starts_with("glTF")) return true;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

}  // namespace

LoadedScene load_scene(const std::filesystem::path& path) {
  if (path.extension() == ".json" && is_json_scene(path)) return load_json_scene(path);
  std::error_code error;
  const bool has_content = std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) > 0;
  // What cannot be opened gets its message from the reader.
  if (has_content && !looks_like_gltf(path) && std::ifstream(path)) {
    throw InputError(path.string(), "", "is neither a .gltf nor a .glb file");
  }
  return load_gltf(path);
}

}  // namespace candil
