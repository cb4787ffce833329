#include "apps/render_command.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <iterator>

#include "apps/exit_code.h"
#include "apps/file_defaults.h"
#include "apps/interrupt.h"
#include "apps/messages.h"
#include "apps/progress.h"
#include "apps/statistics.h"
#include "apps/versions.h"
#include "core/accelerator.h"
#include "io/atomic_file.h"
#include "io/image_file.h"
#include "io/load_scene.h"
#include "materials/alpha.h"

namespace candil {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Everything that is made from the scene file before the first ray; the parts refer to the scene, which stays where it
/// is.
struct PreparedScene {
  Scene scene;
  std::vector<std::filesystem::path> files;  // that were read
  RenderDefaults defaults;
  std::unique_ptr<Accelerator> accelerator;
  std::unique_ptr<LightSampler> lights;
  std::unique_ptr<BsdfTables> tables;
  RenderTimes times;
};

void load(const RenderOptions& options, PreparedScene& prepared) {
  LoadedScene loaded = load_scene(options.scene);
  for (const std::string& warning : loaded.warnings) print_warning(warning);
  prepared.scene = std::move(loaded.scene);
  prepared.files = std::move(loaded.files);
  if (!options.environment.image.empty()) prepared.files.push_back(options.environment.image);
  prepared.scene.environment = choose_environment(prepared.scene, options.environment, loaded.is_lit);
  prepared.defaults = std::move(loaded.render_defaults);
}

std::unique_ptr<PreparedScene> prepare(const RenderOptions& options) {
  auto prepared = std::make_unique<PreparedScene>();
  const Clock::time_point start = Clock::now();
  load(options, *prepared);
  prepared->lights = std::make_unique<LightSampler>(prepared->scene);
  if (prepared->lights->is_empty()) print_warning(options.scene.string() + ": no light, the picture will be black");
  prepared->tables = std::make_unique<BsdfTables>(prepared->scene);
  prepared->times.load = seconds_since(start);
  const Clock::time_point bvh_start = Clock::now();
  prepared->accelerator = make_accelerator(prepared->scene, alpha_filter(), options.accelerator);
  prepared->times.bvh = seconds_since(bvh_start);
  return prepared;
}

const char* integrator_name(IntegratorKind kind) {
  switch (kind) {
    case IntegratorKind::path:
      return "path";
    case IntegratorKind::naive:
      return "naive";
    case IntegratorKind::classic:
      return "classic";
    case IntegratorKind::normals:
      return "normals";
    case IntegratorKind::albedo:
      return "albedo";
  }
  return "";
}

/// Only what decides the pixels: the same command writes the same file, byte for byte.
ImageMetadata describe(const RenderOptions& options, const RenderSettings& settings, const CameraChoice& camera,
                       std::uint32_t samples) {
  return {{"candil:version", candil_version()},           {"candil:scene", options.scene.filename().string()},
          {"candil:camera", camera.description},          {"candil:integrator", integrator_name(settings.integrator)},
          {"candil:seed", std::to_string(settings.seed)}, {"candil:spp", std::to_string(samples)}};
}

void report(const RenderOptions& options, std::span<const Output> outputs, const RenderResult& result) {
  if (result.non_finite_samples > 0)
    print_warning(fmt::format("{} samples were not finite and count as black", result.non_finite_samples));
  if (options.aovs.with_variance && result.film.sample_count() < 2)
    print_warning("--variance: one sample per pixel tells nothing about the noise; the layer is 0");
  if (options.is_quiet) return;
  for (const Output& output : outputs)
    print_note(fmt::format("wrote {} ({}x{}, {} spp, {:.1f} s)",
                           output.is_standard_output() ? "standard output" : output.path.string(), result.film.width(),
                           result.film.height(), result.film.sample_count(), result.seconds));
}

}  // namespace

int run_render(const RenderOptions& asked) {
  const std::vector<Output> outputs = plan_outputs(asked.outputs, asked.scene);
  const std::vector<Output> aov_files = plan_aov_files(asked.aovs, outputs, asked.scene);
  std::vector<Output> files = outputs;
  files.insert(files.end(), aov_files.begin(), aov_files.end());
  for (const Output& output : outputs) {
    if (asked.display.is_transparent && !output.is_standard_output() && !has_alpha_channel(output.path))
      print_warning(output.path.string() + ": the format has no alpha, the background will be black");
  }
  if (!asked.statistics.empty()) check_writable(asked.statistics);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(asked.settings.threads));
  tbb::task_arena arena(asked.settings.threads);
  const std::unique_ptr<PreparedScene> prepared = arena.execute([&] { return prepare(asked); });
  const RenderOptions options = with_file_defaults(asked, prepared->defaults);
  check_inputs_survive(files, options.statistics, prepared->files);

  const CameraChoice camera = choose_camera(prepared->scene, options.camera, options.size);
  RenderSettings settings = options.settings;
  settings.width = camera.size.width, settings.height = camera.size.height;
  settings.transparent_background = options.display.is_transparent;
  settings.aovs = options.aovs.list;
  const std::atomic<bool>& stop = catch_interrupts();
  Progress progress(options.is_quiet, settings);
  progress.start(options.scene.filename().string());
  const RenderContext context{prepared->scene, *prepared->accelerator, *prepared->lights, *prepared->tables};
  const RenderResult result = render(
      context, camera.camera, settings, [&](const RenderProgress& now) { progress.update(now); }, &stop);
  progress.finish();

  ImageMetadata metadata = describe(options, settings, camera, result.film.sample_count());
  std::ranges::move(describe_ids(prepared->scene, settings.aovs), std::back_inserter(metadata));
  std::vector<ImageLayer> layers = result.aovs;
  if (options.aovs.with_variance) layers.push_back(variance_layer(result.film));
  write_outputs(outputs, result.film.mean(), options.display, metadata, {layers, aov_files});
  if (!options.statistics.empty())
    write_statistics(options.statistics, prepared->scene, settings, result, prepared->times,
                     prepared->accelerator->memory_bytes());
  report(options, files, result);
  return result.was_interrupted ? exit_interrupted : exit_done;
}

}  // namespace candil
