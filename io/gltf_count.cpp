#include "io/gltf_count.h"

#include <nlohmann/json.hpp>

namespace candil {

namespace {

using nlohmann::json;

const json& member(const json& object, const char* key) {
  static const json none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

std::vector<std::string> names(const json& elements) {
  std::vector<std::string> names;
  for (const json& element : elements) {
    const json& name = member(element, "name");
    names.push_back(name.is_string() ? name.get<std::string>() : "");
  }
  return names;
}

}  // namespace

void count_gltf_contents(const json& root, GltfContents& contents) {
  constexpr int points = 0, line_strip = 3;
  contents.scenes = names(member(root, "scenes"));
  contents.skins = member(root, "skins").size();
  const json& extensions = member(root, "extensions");
  if (extensions.contains("KHR_materials_variants")) {
    contents.variants = names(member(extensions.at("KHR_materials_variants"), "variants"));
  }
  for (const json& mesh : member(root, "meshes")) {
    for (const json& primitive : member(mesh, "primitives")) {
      const int mode = primitive.value("mode", 4);
      if (!member(primitive, "targets").empty()) ++contents.morphed_primitives;
      if (mode == points) ++contents.point_primitives;
      if (mode > points && mode <= line_strip) ++contents.line_primitives;
    }
  }
}

}  // namespace candil
