#include "apps/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "apps/arguments.h"
#include "apps/bench_arguments.h"
#include "apps/check/check_arguments.h"
#include "apps/compare/compare_arguments.h"
#include "apps/extension_list.h"
#include "apps/fidelity_arguments.h"
#include "apps/messages.h"
#include "apps/render_arguments.h"
#include "apps/scene_arguments.h"
#include "apps/tonemap_arguments.h"
#include "apps/usage_error.h"
#include "apps/versions.h"

namespace candil {
namespace {

constexpr const char* general_footer = R"(
`render` is the default: `candil model.glb` writes model.png into the current folder.
`candil COMMAND --help` lists the options of a command.

Examples:
  candil model.glb
  candil model.glb -o picture.png --spp 256 --size 1920x1080
  candil info model.glb
  candil tonemap picture.exr -o picture.png --operator agx
  candil bench model.glb --accel embree --accel embree:quality=high
  candil compare golden.png picture.png --threshold flip=0.02 --html report.html
  candil check suite.toml --junit out.xml
  candil --list-extensions
  candil fidelity scenario.json --spp 256

Exit codes: 0 done, 1 difference found, 2 wrong usage, 3 the input cannot be used, 4 the output cannot be
written, 70 a mistake in candil, 130 interrupted.)";

constexpr const char* info_footer = R"(
Examples:
  candil info model.glb
  candil info --json model.glb | jq .triangles)";

void add_info_arguments(CLI::App& app, InfoOptions& options) {
  app.add_option_function<std::string>(
         "SCENE", [&](const std::string& text) { options.scene = text; }, "Scene file: .gltf, .glb, .ply or .json")
      ->required();
  app.add_flag("--json", options.is_json, "Print JSON for machines");
  Arguments arguments(app);
  add_scene_arguments(arguments, options.load);
  app.footer(info_footer);
}

/// The words after the program's name, with `render` put in front where no command is named.
std::vector<std::string> with_command(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  constexpr std::string_view known[] = {"render",           "tonemap", "compare", "check",  "info",
                                        "fidelity",         "bench",   "-h",      "--help", "--version",
                                        "--list-extensions"};
  if (words.empty()) throw UsageError("no scene given; try `candil model.glb` or `candil --help`");
  if (std::ranges::find(known, words.front()) == std::end(known)) words.insert(words.begin(), "render");
  std::ranges::reverse(words);  // the order in which CLI11 takes them
  return words;
}

}  // namespace

Command parse_command_line(int argc, const char* const* argv) {
  CLI::App app("candil: a physically based path tracer", "candil");
  app.set_version_flag("--version", version_line());
  const bool is_listing = argc > 1 && std::string_view(argv[1]) == "--list-extensions";
  app.require_subcommand(is_listing ? 0 : 1);
  bool is_listed = false, is_json = false;
  CLI::Option* const listing =
      app.add_flag("--list-extensions", is_listed, "Print the known glTF extensions, and what candil makes of each");
  app.add_flag("--json", is_json, "Print them as JSON for machines")->needs(listing);
  app.footer(general_footer);

  RenderOptions render_options;
  CLI::App* const render = app.add_subcommand("render", "Render a scene to image files (the default command)");
  add_render_arguments(*render, render_options);
  TonemapOptions tonemap_options;
  CLI::App* const tonemap = app.add_subcommand("tonemap", "Make an image of linear values fit for a display");
  add_tonemap_arguments(*tonemap, tonemap_options);
  CompareOptions compare_options;
  CLI::App* const compare = app.add_subcommand("compare", "Measure what differs between two images");
  add_compare_arguments(*compare, compare_options);
  InfoOptions info_options;
  CLI::App* const info = app.add_subcommand("info", "Tell what is in a scene");
  add_info_arguments(*info, info_options);
  BenchOptions bench_options;
  CLI::App* const bench = app.add_subcommand("bench", "Compare accelerators on the rays of a render");
  add_bench_arguments(*bench, bench_options);
  FidelityOptions fidelity_options;
  CLI::App* const fidelity = app.add_subcommand("fidelity", "Render a scenario of the Khronos render fidelity suite");
  add_fidelity_arguments(*fidelity, fidelity_options);
  CheckOptions check_options;
  CLI::App* const check = app.add_subcommand("check", "Render a suite of scenes and compare with golden images");
  add_check_arguments(*check, check_options);

  try {
    app.parse(with_command(argc, argv));
  } catch (const CLI::CallForHelp&) {
    const std::vector<CLI::App*> named = app.get_subcommands();
    const CLI::App* const asked = named.empty() ? &app : named.front();
    return PrintText{asked->help(asked == &app ? "" : "candil")};
  } catch (const CLI::CallForVersion& version) {
    return PrintText{version.what() + std::string("\n")};
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error.what()) + "; see `candil --help`");
  }
  if (is_listed) {
    if (!app.get_subcommands().empty()) throw UsageError("--list-extensions goes with no command");
    return PrintText{list_extensions(is_json)};
  }
  if (tonemap->parsed()) return tonemap_options;
  if (compare->parsed()) return compare_options;
  if (info->parsed()) return info_options;
  if (bench->parsed()) {
    complete_bench_arguments(bench_options);
    return bench_options;
  }
  if (fidelity->parsed()) {
    note_given_options(*fidelity, fidelity_options.render);
    check_render_arguments(fidelity_options.render);
    return fidelity_options;
  }
  if (check->parsed()) {
    check_options.is_update = check->count("--update") > 0;
    complete_check_arguments(check_options);
    return check_options;
  }
  note_given_options(*render, render_options);
  check_render_arguments(render_options);
  return render_options;
}

}  // namespace candil
