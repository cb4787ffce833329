#include "apps/render_command.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <iterator>

#include "apps/exit_code.h"
#include "apps/interrupt.h"
#include "apps/messages.h"
#include "apps/progress.h"
#include "apps/render_steps.h"
#include "io/atomic_file.h"

namespace candil {
namespace {

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
  const std::unique_ptr<PreparedScene> prepared = arena.execute([&] { return prepare_scene(asked); });
  for (const std::string& warning : prepared->warnings) print_warning(warning);
  const RenderPlan plan = plan_render(*prepared, asked);
  const RenderOptions& options = plan.options;
  check_inputs_survive(files, options.statistics, prepared->files);

  const std::atomic<bool>& stop = catch_interrupts();
  Progress progress(options.is_quiet, plan.settings);
  progress.start(options.scene.filename().string());
  const RenderResult result = render_scene(
      *prepared, plan, [&](const RenderProgress& now) { progress.update(now); }, &stop);
  progress.finish();

  ImageMetadata metadata = describe_render(plan, result.film.sample_count());
  std::ranges::move(describe_ids(prepared->scene, plan.settings.aovs), std::back_inserter(metadata));
  std::vector<ImageLayer> layers = result.aovs;
  if (options.aovs.with_variance) layers.push_back(variance_layer(result.film));
  write_outputs(outputs, result.film.mean(), options.display, metadata, {layers, aov_files});
  if (!options.statistics.empty())
    write_statistics(options.statistics, prepared->scene, plan.settings, result, prepared->times,
                     prepared->accelerator->memory_bytes());
  report(options, files, result);
  return result.was_interrupted ? exit_interrupted : exit_done;
}

}  // namespace candil
