#include "apps/info_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/exit_code.h"
#include "apps/messages.h"
#include "apps/scene_summary.h"
#include "io/load_scene.h"

namespace candil {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(Vec3 v) { return {v.x, v.y, v.z}; }

const char* kind_name(const Camera& camera) {
  return camera.kind == CameraKind::perspective ? "perspective" : "orthographic";
}

Json describe_images(const Scene& scene) {
  Json images = Json::array();
  for (const TextureImage& image : scene.images)
    images.push_back({{"name", image.name},
                      {"width", image.width},
                      {"height", image.height},
                      {"alpha", image.has_alpha},
                      {"bytes", image.bytes()}});
  return images;
}

Json describe_animations(const LoadedScene& loaded) {
  Json animations = Json::array();
  for (const AnimationSummary& animation : loaded.animations)
    animations.push_back({{"name", animation.name}, {"seconds", animation.seconds}});
  return animations;
}

Json describe_cameras(const Scene& scene) {
  Json cameras = Json::array();
  for (const Camera& camera : scene.cameras) cameras.push_back({{"name", camera.name}, {"kind", kind_name(camera)}});
  return cameras;
}

std::string to_json_text(const InfoOptions& options, const LoadedScene& loaded) {
  const SceneSummary summary = summarize(loaded.scene);
  Json json;
  json["file"] = options.scene.string();
  json["meshes"] = summary.meshes;
  json["objects"] = summary.objects;
  json["instances"] = summary.instances;
  json["triangles"] = summary.triangles;
  json["instanced_triangles"] = summary.instanced_triangles;
  json["vertices"] = summary.vertices;
  json["points"] = loaded.thin.points;
  json["line_segments"] = loaded.thin.lines;
  json["shapes"] = {{"sphere", summary.spheres}, {"disc", summary.discs}, {"plane", summary.planes}};
  json["geometry_bytes"] = summary.geometry_bytes;
  json["bytes_per_triangle"] = summary.bytes_per_triangle();
  json["materials"] = summary.materials;
  json["images"] = describe_images(loaded.scene);
  json["texture_bytes"] = summary.texture_bytes;
  json["lights"] = {{"emissive_triangles", summary.emissive_triangles},
                    {"emissive_shapes", summary.emissive_shapes},
                    {"point", summary.point_lights},
                    {"spot", summary.spot_lights},
                    {"directional", summary.directional_lights},
                    {"environment", summary.has_environment}};
  json["cameras"] = describe_cameras(loaded.scene);
  json["animations"] = describe_animations(loaded);
  json["bounds"] = nullptr;
  if (!summary.bounds.is_empty())
    json["bounds"] = {{"low", to_json(summary.bounds.low)}, {"high", to_json(summary.bounds.high)}};
  const GltfContents& contents = loaded.contents;
  json["scenes"] = contents.scenes;
  json["variants"] = contents.variants;
  json["skins"] = contents.skins;
  json["primitives"] = {{"morphed", contents.morphed_primitives},
                        {"points", contents.point_primitives},
                        {"lines", contents.line_primitives}};
  json["extensions_used"] = contents.extensions_used;
  json["extensions_required"] = contents.extensions_required;
  json["extensions_unsupported"] = loaded.extensions_unsupported;
  json["not_honoured"] = Json::array();
  for (const NotHonoured& part : loaded.not_honoured)
    json["not_honoured"].push_back({{"what", part.what}, {"reason", part.reason}});
  json["warnings"] = loaded.warnings;
  // Names out of hostile files need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string with_unit(std::size_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value >= 1e9) return fmt::format("{:.2f} GB", value / 1e9);
  if (value >= 1e6) return fmt::format("{:.1f} MB", value / 1e6);
  return value >= 1e3 ? fmt::format("{:.1f} kB", value / 1e3) : fmt::format("{} bytes", bytes);
}

std::string list(const std::vector<std::string>& names) {
  return names.empty() ? "none" : printable(fmt::format("{}", fmt::join(names, ", ")));
}

/// "0 'Front', 1 'Back'", as their options take them.
std::string numbered(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", i);
    if (!names[i].empty()) text += fmt::format(" '{}'", printable(names[i]));
  }
  return names.size() > most ? fmt::format("{}, ... ({} in all)", text, names.size()) : text;
}

std::string describe_lights(const SceneSummary& summary) {
  return fmt::format("{} emissive triangles, {} emissive shapes, {} point, {} spot, {} directional, {}",
                     summary.emissive_triangles, summary.emissive_shapes, summary.point_lights, summary.spot_lights,
                     summary.directional_lights, summary.has_environment ? "an environment" : "no environment");
}

std::string describe_bounds(const Bounds& bounds) {
  if (bounds.is_empty()) return "empty";
  const Vec3 size = bounds.high - bounds.low;
  return fmt::format("{:g} x {:g} x {:g} m, from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", size.x, size.y, size.z,
                     bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z);
}

std::string to_text(const InfoOptions& options, const LoadedScene& loaded) {
  const SceneSummary summary = summarize(loaded.scene);
  std::string text = printable(options.scene.string()) + "\n";
  const auto line = [&](const char* label, const std::string& value) {
    text += fmt::format("  {:<13}{}\n", label, value);
  };
  line("meshes", fmt::format("{}, in {} objects", summary.meshes, summary.objects));
  line("triangles", fmt::format("{} ({} with instances)", summary.triangles, summary.instanced_triangles));
  if (loaded.thin.points + loaded.thin.lines > 0)
    line("thin", fmt::format("{} points, {} line segments{}", loaded.thin.points, loaded.thin.lines,
                             options.load.point_radius > 0 ? ", as triangles" : ", not shown"));
  line("shapes", fmt::format("{} spheres, {} discs, {} planes", summary.spheres, summary.discs, summary.planes));
  line("instances", fmt::format("{}", summary.instances));
  line("geometry",
       fmt::format("{}, {:.0f} bytes per triangle", with_unit(summary.geometry_bytes), summary.bytes_per_triangle()));
  line("bounds", describe_bounds(summary.bounds));
  line("materials", fmt::format("{}", summary.materials));
  line("textures", fmt::format("{}, {}", loaded.scene.images.size(), with_unit(summary.texture_bytes)));
  for (const TextureImage& image : loaded.scene.images)
    line("", fmt::format("{}x{}{}, {}: {}", image.width, image.height, image.has_alpha ? " with alpha" : "",
                         with_unit(image.bytes()), printable(image.name)));
  line("lights", describe_lights(summary));
  line("cameras", fmt::format("{}", loaded.scene.cameras.size()));
  for (std::size_t i = 0; i < loaded.scene.cameras.size(); ++i)
    line("",
         fmt::format("{}: {} '{}'", i, kind_name(loaded.scene.cameras[i]), printable(loaded.scene.cameras[i].name)));
  const GltfContents& contents = loaded.contents;
  const auto choices = [&](const char* label, const std::vector<std::string>& names, std::size_t least) {
    if (names.size() >= least) line(label, numbered(names));
  };
  choices("scenes", contents.scenes, 2);
  choices("variants", contents.variants, 1);
  if (!loaded.animations.empty()) line("animations", fmt::format("{}", loaded.animations.size()));
  for (std::size_t i = 0; i < loaded.animations.size(); ++i)
    line("", fmt::format("{}: '{}', {:g} s", i, printable(loaded.animations[i].name), loaded.animations[i].seconds));
  if (contents.skins > 0) line("skins", fmt::format("{}", contents.skins));
  if (contents.morphed_primitives + contents.point_primitives + contents.line_primitives > 0)
    line("primitives", fmt::format("{} with morph targets, {} of points, {} of lines", contents.morphed_primitives,
                                   contents.point_primitives, contents.line_primitives));
  line("extensions", list(contents.extensions_used));
  if (!contents.extensions_required.empty()) line("required", list(contents.extensions_required));
  for (const NotHonoured& part : loaded.not_honoured)
    line(&part == loaded.not_honoured.data() ? "not honoured" : "",
         printable(part.what) + ": " + printable(part.reason));
  for (const std::string& warning : loaded.warnings) text += "  warning: " + printable(warning) + "\n";
  return text;
}

}  // namespace

int run_info(const InfoOptions& options) {
  const LoadedScene loaded = load_scene(options.scene, options.load);
  const std::string text = options.is_json ? to_json_text(options, loaded) : to_text(options, loaded);
  std::fputs(text.c_str(), stdout);
  return exit_done;
}

}  // namespace candil
