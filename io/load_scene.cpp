#include "io/load_scene.h"

#include <array>
#include <fstream>
#include <string>
#include <string_view>

#include "io/error.h"
#include "io/gltf_internal.h"
#include "io/json_internal.h"
#include "io/ply_scene.h"

namespace candil {

namespace {

/// The first bytes of a file; empty when it is, or cannot be opened.
std::string read_start(const std::filesystem::path& path) {
  std::array<char, 256> start{};
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};  // a pipe could block for ever
  std::ifstream stream(path, std::ios::binary);
  stream.read(start.data(), start.size());
  return {start.data(), static_cast<std::size_t>(stream.gcount())};
}

bool looks_like_ply(std::string_view text) {
  constexpr std::string_view line_ends_or_blanks = "\r\n \t";
  return text.starts_with("ply") && text.size() > 3 && line_ends_or_blanks.find(text[3]) != std::string_view::npos;
}

/// True for binary glTF and for text that begins, after blanks and a byte order mark, as a JSON object.
bool looks_like_gltf(std::string_view text) {
  if (text.starts_with("glTF")) return true;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

LoadedScene without_choice(LoadedScene loaded, const LoadOptions& options) {
  if (options != LoadOptions{}) loaded.warnings.push_back("only glTF files have scenes and the like to choose from");
  return loaded;
}

enum class SceneKind { json, ply, gltf };

SceneKind kind_of(const std::filesystem::path& path) {
  if (path.extension() == ".json" && is_json_scene(path)) return SceneKind::json;
  const std::string start = read_start(path);
  if (looks_like_ply(start) || (start.empty() && path.extension() == ".ply")) return SceneKind::ply;
  // What cannot be opened gets its message from the reader.
  if (!start.empty() && !looks_like_gltf(start))
    throw InputError(path.string(), "",
                     "is no scene file: it holds neither glTF (.gltf, .glb) nor PLY nor a scene in JSON");
  return SceneKind::gltf;
}

}  // namespace

bool is_gltf_scene(const std::filesystem::path& path) { return kind_of(path) == SceneKind::gltf; }

LoadedScene load_scene(const std::filesystem::path& path, const LoadOptions& options) {
  switch (kind_of(path)) {
    case SceneKind::json:
      return without_choice(load_json_scene(path), options);
    case SceneKind::ply:
      return without_choice(load_ply_scene(path), options);
    case SceneKind::gltf:
      break;
  }
  return load_gltf(path, options);
}

}  // namespace candil
