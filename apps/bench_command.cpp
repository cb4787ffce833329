#include "apps/bench_command.h"

#include <algorithm>
#include <cstdio>
#include <span>

#include "apps/bench_report.h"
#include "apps/exit_code.h"
#include "apps/messages.h"
#include "apps/usage_error.h"
#include "io/atomic_file.h"
#include "io/image_file.h"
#include "io/load_scene.h"

namespace candil {
namespace {

void write_plot(const std::filesystem::path& path, const Chart& chart) {
  if (path.extension() == ".svg") return write_file_atomically(path, chart_svg(chart));
  write_image(path, chart_image(chart), false, {});
}

void check_outputs(const BenchOptions& options) {
  if (!options.json.empty() && options.json != "-") check_writable(options.json);
  if (!options.plot.empty()) check_writable(options.plot);
}

void check_inputs_survive(const BenchOptions& options, std::span<const std::filesystem::path> inputs) {
  const auto check = [&](const char* option, const std::filesystem::path& file) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code status;
      if (std::filesystem::equivalent(file, input, status) && !status)
        throw UsageError(std::string(option) + ": " + file.string() +
                         " is a file that a scene is made of; choose another name");
    }
  };
  check("--json", options.json);
  check("--plot", options.plot);
}

std::vector<Contestant> contestants_of(const BenchOptions& options) {
  std::vector<Contestant> contestants;
  for (const BenchOptions::Accelerator& accelerator : options.accelerators)
    contestants.push_back(make_contestant(accelerator.name, accelerator.options));
  return contestants;
}

BenchedScene bench_scene(const BenchOptions& options, const std::filesystem::path& file) {
  const auto say = [&](const std::string& doing) {
    if (!options.is_quiet) print_note(file.filename().string() + ": " + doing);
  };
  say("loading");
  LoadedScene loaded = load_scene(file, options.load);
  for (const std::string& warning : loaded.warnings) print_warning(warning);
  check_inputs_survive(options, loaded.files);
  Scene scene = std::move(loaded.scene);
  scene.environment = choose_environment(scene, {}, loaded.is_lit);
  const CameraChoice camera = choose_camera(scene, {}, options.size);
  RenderSettings render;
  render.width = options.size.width, render.height = options.size.height;
  render.samples_per_pixel = options.samples_per_pixel;
  const ContestSettings settings{options.threads, options.repetitions, options.longest_replay_seconds};
  return {file, summarize(scene),
          run_contest(scene, camera.camera, render, options.recording_bytes, contestants_of(options), settings, say)};
}

}  // namespace

int run_bench(const BenchOptions& options) {
  check_outputs(options);
  BenchReport report{options, this_machine(), {}};
  const bool prints_tables = options.json != "-";
  if (prints_tables) std::printf("%s\n", describe_machine(report).c_str());
  bool has_mismatch = false;
  for (const std::filesystem::path& file : options.scenes) {
    const BenchedScene& scene = report.scenes.emplace_back(bench_scene(options, file));
    if (prints_tables) std::fputs(bench_tables(report, scene).c_str(), stdout);
    std::fflush(stdout);
    for (const std::string& line : describe_mismatches(scene)) print_error(line);
    has_mismatch = has_mismatch || scene.result.has_mismatch();
  }
  if (options.json == "-") {
    std::fputs(bench_json(report).c_str(), stdout);
  } else if (!options.json.empty()) {
    write_file_atomically(options.json, bench_json(report));
  }
  if (!options.plot.empty()) write_plot(options.plot, bench_chart(report));
  return has_mismatch ? exit_difference : exit_done;
}

}  // namespace candil
