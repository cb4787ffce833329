#include "apps/scene_arguments.h"

#include "apps/arguments.h"
#include "apps/option_values.h"

namespace candil {
namespace {

LightUnits parse_light_units(const std::string& option, const std::string& text) {
  if (text == "spec") return LightUnits::spec;
  if (text == "compat") return LightUnits::compat;
  if (text == "raw") return LightUnits::raw;
  fail_choice(option, text, {"spec", "compat", "raw"});
}

}  // namespace

void add_scene_arguments(Arguments& arguments, LoadOptions& options) {
  arguments.group("Scene");
  arguments.add("--scene", "INDEX|NAME", "A scene of the glTF file (default: the one the file names, else the first)",
                [&](const auto&, const auto& text) { options.scene = text; });
  arguments.add("--variant", "INDEX|NAME", "A variant of the materials of the glTF file (default: none)",
                [&](const auto&, const auto& text) { options.variant = text; });
  arguments.add(
      "--animation", "INDEX|NAME|all",
      "An animation of the glTF file, or all of them at once (default: none; the first with --at or --frames)",
      [&](const auto&, const auto& text) { options.animation = text; });
  arguments.add("--at", "SECONDS", "The time in the animation (default 0); it stands still beyond its ends",
                [&](const auto& option, const auto& text) { options.at = parse_real(option, text, 0, 1e9); });
  arguments.add(
      "--light-units", "KIND",
      "Punctual lights of glTF: spec (candela and lux, default); files that Blender exported otherwise: compat "
      "(Unitless: W/sr, W/m2), raw (W, W/m2)",
      [&](const auto& option, const auto& text) { options.light_units = parse_light_units(option, text); });
  arguments.add("--point-radius", "METRES",
                "Show points and lines of the glTF file as spheres and tubes of this radius (default: not shown)",
                [&](const auto& option, const auto& text) {
                  options.point_radius = static_cast<float>(parse_real(option, text, 1e-9, 1e6));
                });
  arguments.add("--experimental", "NAME",
                "Turn on an experiment: volume-scatter (KHR_materials_volume_scatter, a draft)",
                [&](const auto& option, const auto& text) {
                  if (text != "volume-scatter") fail_choice(option, text, {"volume-scatter"});
                  options.experiments = {"KHR_materials_volume_scatter"};
                });
}

}  // namespace candil
