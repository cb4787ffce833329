#include "apps/bench_arguments.h"

#include <algorithm>
#include <thread>

#include "apps/accelerator_argument.h"
#include "apps/arguments.h"
#include "apps/render_arguments.h"
#include "apps/scene_arguments.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

constexpr const char* footer = R"(
A render with the path integrator is recorded, and its rays are shot again with every accelerator: all answers are
compared with those of the first one, then all are timed in turns. Rates are medians over the repetitions, with the
lowest and the highest. "bare Embree" is rtcIntersect1 and rtcOccluded1 with nothing around them. The renderer's share
is the time of the bare replay, by the first accelerator, over that of a real render. Exit code 1 if answers differ.

Examples:
  candil bench model.glb
  candil bench model.glb --accel embree --accel embree:robust=off --threads 2
  candil bench model.glb --accel embree --accel brute --limit 10
  candil bench a.glb b.json --json bench.json --plot bench.svg
  candil bench a.glb --json - --quiet | jq .scenes[0].contestants)";

constexpr std::size_t most_thread_counts = 8;

std::vector<int> parse_threads(const std::string& option, const std::string& text) {
  std::vector<int> threads;
  for (const std::string_view part : split(text, ','))
    threads.push_back(static_cast<int>(parse_integer(option, part, 1, 1024)));
  if (threads.size() > most_thread_counts)
    throw UsageError(option + ": more than " + std::to_string(most_thread_counts) + " numbers");
  return threads;
}

std::filesystem::path parse_plot(const std::string& option, const std::string& text) {
  std::filesystem::path path = text;
  if (path.extension() != ".svg" && path.extension() != ".png")
    throw UsageError(option + ": " + text + ": unknown format; use .svg or .png");
  return path;
}

void add_measurement_arguments(Arguments& arguments, BenchOptions& options) {
  arguments.group("Measurement");
  arguments.add("--threads", "N[,N...]", "Numbers of threads (default: 1 and one for each processor)",
                [&](const auto& option, const auto& text) { options.threads = parse_threads(option, text); });
  arguments.add("--spp", "N", "Samples per pixel of the render whose rays are recorded (default 4)",
                [&](const auto& option, const auto& text) {
                  options.samples_per_pixel = static_cast<std::uint32_t>(parse_integer(option, text, 1, max_samples));
                });
  arguments.add("--size", "WxH", "Its pixels (default 512x512)",
                [&](const auto& option, const auto& text) { options.size = parse_size(option, text); });
  arguments.add("--repeat", "N", "Times that everything is measured (default 5)",
                [&](const auto& option, const auto& text) {
                  options.repetitions = static_cast<int>(parse_integer(option, text, 1, 1000));
                });
  arguments.add("--memory", "MB", "Largest recording (default 256); paths that do not fit are left out",
                [&](const auto& option, const auto& text) {
                  options.recording_bytes = static_cast<std::size_t>(parse_integer(option, text, 1, 1 << 20)) << 20;
                });
  arguments.add("--limit", "SECONDS",
                "Longest replay of the rays of one kind (default 2); who is slower shoots a part of them, and builds "
                "that take long are not repeated",
                [&](const auto& option, const auto& text) {
                  options.longest_replay_seconds = parse_real(option, text, 1e-3, 1e6);
                });
}

void add_output_arguments(Arguments& arguments, BenchOptions& options) {
  arguments.group("Output");
  arguments.add("--json", "FILE", "Write everything as JSON; - is standard output, instead of the tables",
                [&](const auto&, const auto& text) { options.json = text; });
  arguments.add("--plot", "FILE", "Draw the rates as bars, into an .svg or a .png file",
                [&](const auto& option, const auto& text) { options.plot = parse_plot(option, text); });
  arguments.add_flag("--quiet,-q", "Do not tell what is being done; tables, warnings and errors stay",
                     options.is_quiet);
}

}  // namespace

void add_bench_arguments(CLI::App& app, BenchOptions& options) {
  Arguments arguments(app);
  app.add_option_function<std::vector<std::string>>(
         "SCENE", [&](const std::vector<std::string>& texts) { options.scenes.assign(texts.begin(), texts.end()); },
         "Scene files: .gltf, .glb, .ply or .json")
      ->required();
  app.add_option_function<std::vector<std::string>>(
         "--accel",
         [&](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             options.accelerators.push_back({text, parse_accelerator("--accel", text)});
         },
         std::string("A contestant; may be given several times (default: all but brute). ") + accelerator_help)
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->group("Measurement");
  add_measurement_arguments(arguments, options);
  add_scene_arguments(arguments, options.load);
  add_output_arguments(arguments, options);
  app.footer(footer);
}

void complete_bench_arguments(BenchOptions& options) {
  if (options.accelerators.empty()) {
    for (const std::string& name : accelerator_names()) {
      const AcceleratorOptions accelerator = parse_accelerator("--accel", name);
      if (accelerator.kind != AcceleratorKind::brute) options.accelerators.push_back({name, accelerator});
    }
  }
  if (!options.threads.empty()) return;
  const auto all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.threads = {1};
  if (all > 1) options.threads.push_back(all);
}

}  // namespace candil
