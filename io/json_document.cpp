#include "io/json_document.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "io/json_parse.h"
#include "io/json_schema.h"
#include "io/resource.h"

namespace candil {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Reads files depth first.
class IncludeReader {
 public:
  /// `path` exists when it was included; `place` then is where.
  void read(const fs::path& path, const std::string& name) {
    JsonFile file{name, path.parent_path(), nullptr, path};
    const Bytes bytes = read_file(path, name, "");
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    file.root = std::make_shared<const json>(parse_json_with_comments(text, name));
    scene_schema().check(*file.root, name);
    if (const std::optional<JsonNode> include = JsonNode(file).find("include")) {
      open_.push_back(fs::canonical(path));
      for (std::size_t i = 0; i < include->size(); ++i) read_included((*include)[i]);
      open_.pop_back();
    }
    files_.push_back(std::move(file));
  }

  std::vector<JsonFile> take() { return std::move(files_); }

 private:
  void read_included(const JsonNode& reference) {
    const JsonFile& file = reference.file();
    const fs::path path = resolve_reference(file.folder, reference.text(), file.name, reference.place());
    if (std::ranges::find(open_, path) != open_.end()) reference.fail("includes itself");
    if (!read_.insert(path).second) return;  // included by two files
    constexpr std::size_t most = 256;        // with the first file, which is not in read_; the depth is bounded with it
    if (read_.size() >= most) reference.fail("is the 257th file of the scene");
    read(path, (fs::path(file.name).parent_path() / reference.text()).string());
  }

  std::vector<fs::path> open_;
  std::set<fs::path> read_;
  std::vector<JsonFile> files_;
};

}  // namespace

bool is_json_scene(const fs::path& path) {
  const Bytes bytes = read_file(path, path.string(), "");
  return !has_root_key({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "asset");
}

std::vector<JsonFile> read_json_files(const fs::path& path) {
  IncludeReader reader;
  reader.read(path, path.string());
  return reader.take();
}

}  // namespace candil
