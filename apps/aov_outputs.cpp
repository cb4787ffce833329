#include "apps/aov_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/usage_error.h"
#include "io/atomic_file.h"

namespace candil {
namespace {

bool is_same_place(const std::filesystem::path& a, const std::filesystem::path& b) {
  return std::filesystem::absolute(a).lexically_normal() == std::filesystem::absolute(b).lexically_normal();
}

constexpr const char* variance_name = "variance";

std::vector<std::string> layer_names(const AovOptions& options) {
  std::vector<std::string> names;
  for (const Aov aov : options.list) names.push_back(aov_name(aov));
  if (options.with_variance) names.emplace_back(variance_name);
  return names;
}

std::string name_list(const std::vector<std::string>& names) {
  // Names out of hostile files need not be UTF-8.
  return nlohmann::json(names).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace

ImageLayer variance_layer(const Film& film) { return {variance_name, {"R", "G", "B"}, film.variance()}; }

std::vector<Output> plan_aov_files(const AovOptions& options, std::span<const Output> outputs,
                                   const std::filesystem::path& scene) {
  const auto is_layered = [](const Output& output) { return has_layers(output.path); };
  if (!options.is_separate && std::ranges::any_of(outputs, is_layered)) return {};
  const auto first = std::ranges::find(outputs, false, &Output::is_standard_output);
  const std::filesystem::path beside = first == outputs.end() ? scene.filename() : first->path;
  std::vector<Output> files;
  for (const std::string& name : layer_names(options)) {
    std::filesystem::path path = beside;
    path.replace_extension(name + ".exr");
    if (std::ranges::any_of(outputs, [&](const Output& output) { return is_same_place(output.path, path); }))
      throw UsageError(fmt::format("--{0}: {1} is an output already; choose another name with -o",
                                   name == variance_name ? name : "aov", path.string()));
    check_writable(path);
    files.push_back({path});
  }
  return files;
}

ImageMetadata describe_ids(const Scene& scene, std::span<const Aov> aovs) {
  constexpr std::size_t most = 10'000;
  const auto is_wanted = [&](Aov aov) { return std::ranges::find(aovs, aov) != aovs.end(); };
  ImageMetadata metadata;
  if (is_wanted(Aov::material) && scene.materials.size() <= most) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials) names.push_back(material.name);
    metadata.emplace_back("candil:materials", name_list(names));
  }
  if (is_wanted(Aov::object) && scene.instances.size() + scene.shapes.size() <= most) {
    std::vector<std::string> names;
    for (const Instance& instance : scene.instances) names.push_back(instance.name);
    for (const Shape& shape : scene.shapes) names.push_back(shape.name);
    metadata.emplace_back("candil:objects", name_list(names));
  }
  return metadata;
}

}  // namespace candil
