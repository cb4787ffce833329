#include <algorithm>
#include <iterator>
#include <type_traits>

#include "io/json_internal.h"
#include "io/json_schema.h"
#include "io/resource.h"

namespace candil {
namespace {

void add_object(const JsonNode& object, JsonMaterials& materials, JsonGeometryFiles& geometry, LoadedScene& loaded) {
  const std::string type = object["type"].text();
  if (type == "sphere" || type == "disc" || type == "plane") return add_shape(object, materials, loaded.scene);
  if (type == "gltf") return add_gltf(object, materials, geometry, loaded);
  if (type == "ply") return add_ply(object, materials, geometry, loaded);
  add_mesh(object, materials, loaded.scene);
}

/// The elements of the root member `key` of every file, in order.
template <typename Function>
void for_each_element(const std::vector<JsonFile>& files, std::string_view key, const Function& function) {
  for (const JsonFile& file : files) {
    const auto elements = JsonNode(file).find(key);
    for (std::size_t i = 0; elements && i < elements->size(); ++i) function((*elements)[i]);
  }
}

bool has_emission(const Scene& scene) { return std::ranges::any_of(scene.materials, &Material::is_emissive); }

void sort_unique(std::vector<std::string>& words) {
  std::ranges::sort(words);
  const auto rest = std::ranges::unique(words);
  words.erase(rest.begin(), rest.end());
}

}  // namespace

std::optional<JsonNode> find_last(const std::vector<JsonFile>& files, std::string_view key) {
  for (auto file = files.rbegin(); file != files.rend(); ++file)
    if (const auto member = JsonNode(*file).find(key)) return member;
  return {};
}

JsonNode find_named(const std::vector<JsonFile>& files, std::string_view section, const JsonNode& reference) {
  const std::string name = reference.text();
  std::vector<std::string> names;
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    const auto members = JsonNode(*file).find(section);
    if (!members) continue;
    if (const auto found = members->find(name)) return *found;
    std::ranges::copy(members->keys(), std::back_inserter(names));
  }
  const std::string_view similar = most_similar(name, std::vector<std::string_view>(names.begin(), names.end()));
  reference.fail(quoted_text(name) + " is none of the " + std::string(section) +
                 (similar.empty() ? "" : "; did you mean " + quoted_text(similar) + "?"));
}

std::filesystem::path referenced_file(const JsonNode& reference) {
  const JsonFile& file = reference.file();
  return resolve_reference(file.folder, reference.text(), file.name, reference.place());
}

std::string object_name(const JsonNode& object) { return kept_name(object.text("name", object.place())); }

RenderDefaults read_render_defaults(const std::vector<JsonFile>& files) {
  RenderDefaults defaults;
  for (const JsonFile& file : files) {  // later files replace key by key
    const auto render = JsonNode(file).find("render");
    if (!render) continue;
    const auto integer = [&](const char* key, auto& target) {
      using Value = typename std::remove_reference_t<decltype(target)>::value_type;
      if (const auto value = render->find(key)) target = static_cast<Value>(value->integer());
    };
    const auto word = [&](const char* key, std::optional<std::string>& target) {
      if (const auto value = render->find(key)) target = value->text();
    };
    if (const auto size = render->find("size"))
      defaults.size = {static_cast<int>((*size)[0].integer()), static_cast<int>((*size)[1].integer())};
    integer("spp", defaults.samples_per_pixel);
    integer("max_bounces", defaults.max_bounces);
    integer("seed", defaults.seed);
    word("integrator", defaults.integrator);
    word("filter", defaults.filter);
    word("tonemap", defaults.tonemap);
    if (const auto exposure = render->find("exposure")) defaults.exposure = exposure->number();
  }
  return defaults;
}

LoadedScene load_json_scene(const std::filesystem::path& path) {
  const std::vector<JsonFile> files = read_json_files(path);
  LoadedScene loaded;
  for (const JsonFile& file : files) loaded.files.push_back(file.path);
  Scene& scene = loaded.scene;
  add_cameras(files, scene);
  const auto medium = find_last(files, "medium");
  JsonTextures textures(files, loaded);
  JsonMaterials materials(files, scene, textures, medium ? medium->number("ior", 1) : 1);
  JsonGeometryFiles geometry;
  for_each_element(files, "objects", [&](const JsonNode& object) { add_object(object, materials, geometry, loaded); });
  for_each_element(files, "lights", [&](const JsonNode& light) { add_light(light, scene); });
  const auto environment = find_last(files, "environment");
  if (environment) scene.environment = read_environment_of(*environment, loaded);
  loaded.is_lit = environment || !scene.punctual_lights.empty() || has_emission(scene);
  loaded.render_defaults = read_render_defaults(files);
  sort_unique(loaded.contents.extensions_used);
  sort_unique(loaded.contents.extensions_required);
  sort_unique(loaded.extensions_unsupported);
  bake_single_instances(scene);
  return loaded;
}

}  // namespace candil
