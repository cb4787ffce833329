#include "apps/fidelity_arguments.h"

#include <CLI/CLI.hpp>

#include "apps/arguments.h"
#include "apps/option_values.h"
#include "apps/render_arguments.h"

namespace candil {
namespace {

constexpr const char* footer = R"(
Renders what the harness of the Khronos render fidelity suite (glTF-Render-Fidelity, before: model-viewer's
render-fidelity-tools) asks of an external renderer. It calls a program with one more argument, JSON as

  {"scenario": {"model": "../../../Models/Box.glb", "lighting": "../../../environments/lightroom_14b.hdr",
                "dimensions": {"width": 768, "height": 450}, "target": {"x": 0, "y": 0.3, "z": 0},
                "orbit": {"theta": 0, "phi": 90, "radius": 1}, "verticalFoV": 45, "renderSkybox": false},
   "outputFile": "test/goldens/khronos-Box/candil-golden.png"}

What a scenario leaves out is as in the harness: 768 x 768, target 0,0,0, orbit 0,90,1, 45 degrees, no skybox. Options of
`candil render` go before what the scenario wants. See docs/render-fidelity.md.

Examples:
  candil fidelity scenario.json --spp 256
  candil fidelity '{"scenario": {"model": "box.glb", "orbit": {"radius": 3}}}' --base . -o box.png
In the harness' config.json:
  {"name": "candil", "description": "candil", "command": {"executable": "candil", "args": ["fidelity", "--spp", "256"]}})";

}  // namespace

void add_fidelity_arguments(CLI::App& app, FidelityOptions& options) {
  app.add_option_function<std::string>(
         "SCENARIO", [&](const std::string& text) { options.scenario = text; }, "A JSON file, or the JSON itself")
      ->required();
  Arguments arguments(app);
  arguments.group("Scenario");
  arguments.add(
      "--base", "FOLDER",
      "What the paths of model and lighting are relative to (default: the folder of the file; for JSON itself "
      "test/renderers/candil, as the harness means them)",
      [&](const auto&, const auto& text) { options.base = text; });
  arguments.add(
      "--pixel-ratio", "X", "Pixels of the picture for each one of the scenario, along each side (default 2)",
      [&](const auto& option, const auto& text) { options.pixel_ratio = parse_real(option, text, 0.01, 64); });
  add_render_options(app, options.render);
  app.footer(footer);
}

}  // namespace candil
