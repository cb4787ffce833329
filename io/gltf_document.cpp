#include "io/gltf_document.h"

#include <algorithm>
#include <fstream>  // tiny_gltf.h needs it even without a file system
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "io/error.h"
#include "io/gltf_container.h"
#include "io/gltf_count.h"
#include "io/gltf_extensions.h"
#include "io/gltf_schema.h"

#define TINYGLTF_IMPLEMENTATION
#include "io/gltf_tinygltf.h"

namespace candil {

namespace {

using nlohmann::json;

/// Parsers recurse; a file of nothing but brackets must not overflow their stack.
void check_nesting(std::string_view text, const std::string& name) {
  constexpr int deepest = 128;
  int depth = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_string) {
      if (c == '\\') ++i;
      is_string = c != '"';
    } else if (c == '"') {
      is_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > deepest) throw InputError(name, "JSON", "is nested deeper than 128 levels");
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

json parse_json(std::string_view text, const std::string& name) {
  if (text.empty()) throw InputError(name, "", "the file is empty");
  check_nesting(text, name);
  json root;
  try {
    root = json::parse(text);
  } catch (const json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 3, column 7: ..." without its first part, on one line.
    std::string message = error.what();
    const std::size_t bracket = message.find("] ");
    if (bracket != std::string::npos) message.erase(0, bracket + 2);
    std::replace_if(
        message.begin(), message.end(), [](unsigned char c) { return c < 0x20; }, '?');
    throw InputError(name, "JSON", message.substr(0, 200));
  }
  if (!root.is_object()) throw InputError(name, "JSON", "the root must be an object");
  return root;
}

/// {2, 0} of "2.0".
std::optional<std::pair<int, int>> parse_version(const json& asset, const char* property, const std::string& name) {
  if (!asset.contains(property)) return {};
  const std::string place = std::string("asset.") + property;
  if (!asset.at(property).is_string()) throw InputError(name, place, "must be a string");
  const std::string text = asset.at(property).get<std::string>();
  const std::size_t dot = text.find('.');
  const auto is_number = [](std::string_view digits) {
    return !digits.empty() && digits.size() < 4 && digits.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (dot == std::string::npos || !is_number(text.substr(0, dot)) || !is_number(text.substr(dot + 1))) {
    throw InputError(name, place, quoted_text(text) + " is not a version such as 2.0");
  }
  return std::pair(std::stoi(text.substr(0, dot)), std::stoi(text.substr(dot + 1)));
}

/// Specification, section 3.2: a client renders 2.x if minVersion allows it.
void check_version(const json& root, const std::string& name) {
  if (!root.contains("asset") || !root.at("asset").is_object()) {
    throw InputError(name, "asset", "is missing: this is not a glTF 2.0 file");
  }
  const auto version = parse_version(root.at("asset"), "version", name);
  if (!version) throw InputError(name, "asset.version", "is missing");
  const auto text = [](std::pair<int, int> v) { return std::to_string(v.first) + "." + std::to_string(v.second); };
  if (version->first != 2) throw InputError(name, "asset.version", text(*version) + " is not supported, only 2.x is");
  const auto least = parse_version(root.at("asset"), "minVersion", name);
  if (least && *least > std::pair(2, 0)) {
    throw InputError(name, "asset.minVersion", text(*least) + " is not supported, 2.0 is");
  }
}

std::vector<std::string> read_extension_list(const json& root, const char* property, const std::string& name) {
  std::vector<std::string> names;
  if (!root.contains(property)) return names;
  const json& list = root.at(property);
  if (!list.is_array()) throw InputError(name, property, "must be an array");
  for (const json& element : list) {
    if (!element.is_string()) throw InputError(name, property, "must hold strings");
    names.push_back(element.get<std::string>());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

const json& array_of(const json& root, const char* property) {
  static const json none = json::array();
  const auto found = root.find(property);
  return found == root.end() ? none : *found;
}

GltfImageSource read_image_source(const json& image, std::size_t index, const std::string& name) {
  GltfImageSource source;
  source.name = image.value("name", std::string());
  source.uri = image.value("uri", std::string());
  source.buffer_view = image.value("bufferView", -1);
  if (image.contains("uri") == image.contains("bufferView")) {
    throw InputError(name, "images[" + std::to_string(index) + "]", "must have either a uri or a bufferView");
  }
  return source;
}

GltfSkin read_skin(const json& skin) {
  return {skin.value("inverseBindMatrices", -1), skin.at("joints").get<std::vector<std::size_t>>()};
}

GltfAnimation read_animation(const json& source) {
  GltfAnimation animation;
  animation.name = source.value("name", std::string());
  for (const json& sampler : source.at("samplers")) {
    animation.samplers.push_back({sampler.at("input").get<int>(), sampler.at("output").get<int>(),
                                  sampler.value("interpolation", std::string("LINEAR"))});
  }
  static const json::json_pointer pointer("/extensions/KHR_animation_pointer/pointer");
  for (const json& channel : source.at("channels")) {
    const json& target = channel.at("target");
    animation.channels.push_back({channel.at("sampler").get<std::size_t>(), target.value("node", -1),
                                  target.at("path").get<std::string>(),
                                  target.contains(pointer) ? target.at(pointer).get<std::string>() : std::string()});
  }
  return animation;
}

/// The parts of the file that GltfDocument::pose() can replace.
json movable_parts(const json& root) {
  json parts = json::object();
  for (const char* part : {"nodes", "meshes", "cameras", "materials", "extensions"}) {
    if (root.contains(part)) parts[part] = root.at(part);
  }
  return parts;
}

/// Indices of a primitive whose accessor has no buffer view.
struct BareIndices {
  std::size_t mesh, primitive;
  int accessor;
};

/// tinygltf refuses accessors of indices without a buffer view. Those of Draco streams may go without, and so may those
/// of zeros that sparse ones replace: they are taken out of the JSON, to be put back into what tinygltf makes of it.
std::vector<BareIndices> take_bare_indices(json& root) {
  std::vector<BareIndices> taken;
  if (!root.contains("meshes")) return taken;
  json& meshes = root.at("meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    json& primitives = meshes[m].at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (!primitives[p].contains("indices")) continue;
      const int accessor = primitives[p].at("indices").get<int>();
      if (root.at("accessors").at(static_cast<std::size_t>(accessor)).contains("bufferView")) continue;
      taken.push_back({m, p, accessor});
      primitives[p].erase("indices");
    }
  }
  return taken;
}

/// What the loader reads through tinygltf: without the parts that hold bytes, and without those candil has no use for.
std::string reduced_json(json& root) {
  for (const char* part : {"buffers", "images", "skins", "animations"}) root.erase(part);
  if (root.contains("extensions")) {
    json kept = json::object();
    json& extensions = root.at("extensions");
    for (const char* const name : {"EXT_lights_image_based", "KHR_lights_punctual"})
      if (extensions.contains(name)) kept[name] = extensions[name];
    extensions = kept;
  }
  return root.dump();
}

std::unique_ptr<tinygltf::Model> parse_model(const std::string& text, const std::string& name) {
  auto model = std::make_unique<tinygltf::Model>();
  std::string error, warning;
  bool is_parsed = false;
  try {
    is_parsed = tinygltf::TinyGLTF().LoadASCIIFromString(
        model.get(), &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!is_parsed) {
    while (!error.empty() && error.back() == '\n') error.pop_back();
    std::replace(error.begin(), error.end(), '\n', ' ');
    throw InputError(name, "glTF", error.empty() ? "cannot be parsed" : error);
  }
  return model;
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& path, std::span<const std::string> experiments)
    : name_(path.string()), folder_(path.parent_path()), files_({path}), file_(read_file(path, name_, "")) {
  const GltfContainer container = split_gltf(file_, name_);
  json root = parse_json(container.json, name_);
  check_version(root, name_);
  contents_.extensions_used = read_extension_list(root, "extensionsUsed", name_);
  contents_.extensions_required = read_extension_list(root, "extensionsRequired", name_);
  refuse_unknown_gltf_extensions(contents_.extensions_required, name_, experiments);
  // Files without scenes that name one anyway are about; they lose nothing.
  if (!root.contains("scenes")) root.erase("scene");
  check_gltf_schema(root, name_);
  count_gltf_contents(root, contents_);

  buffers_ = read_gltf_buffers(root, container, folder_, name_, files_);
  for (const json& image : array_of(root, "images")) {
    images_.push_back(read_image_source(image, images_.size(), name_));
  }
  for (const json& animation : array_of(root, "animations")) animations_.push_back(read_animation(animation));
  for (const json& skin : array_of(root, "skins")) skins_.push_back(read_skin(skin));
  const std::vector<BareIndices> bare = take_bare_indices(root);
  model_ = parse_model(reduced_json(root), name_);
  for (const BareIndices& indices : bare)
    model_->meshes[indices.mesh].primitives[indices.primitive].indices = indices.accessor;
  movable_ = std::make_unique<json>(animations_.empty() ? json::object() : movable_parts(root));
  compressed_primitives_ = decode_primitives(*this);
}

GltfDocument::~GltfDocument() = default;

void GltfDocument::pose(const json& parts) {
  json text = {{"asset", {{"version", "2.0"}}}};
  for (const char* part : {"nodes", "cameras", "materials", "extensions"}) {
    if (parts.contains(part)) text[part] = parts.at(part);
  }
  const std::unique_ptr<tinygltf::Model> posed = parse_model(text.dump(), name_);
  if (parts.contains("nodes")) model_->nodes = std::move(posed->nodes);
  if (parts.contains("cameras")) model_->cameras = std::move(posed->cameras);
  if (parts.contains("materials")) model_->materials = std::move(posed->materials);
  if (parts.contains("extensions")) model_->lights = std::move(posed->lights);
  const json& meshes = array_of(parts, "meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    if (meshes[m].contains("weights")) model_->meshes[m].weights = meshes[m].at("weights").get<std::vector<double>>();
  }
}

void GltfDocument::fail(const std::string& place, const std::string& message) const {
  throw InputError(name_, place, message);
}

}  // namespace candil
