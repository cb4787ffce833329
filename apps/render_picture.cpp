#include "apps/render_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "apps/messages.h"
#include "apps/progress.h"
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

PlannedFiles plan_files(const RenderOptions& options) {
  PlannedFiles files;
  files.outputs = plan_outputs(options.outputs, options.scene);
  files.aovs = plan_aov_files(options.aovs, files.outputs, options.scene);
  for (const Output& output : files.outputs) {
    if (options.display.is_transparent && !output.is_standard_output() && !has_alpha_channel(output.path))
      print_warning(output.path.string() + ": the format has no alpha, the background will be black");
  }
  if (!options.statistics.empty()) check_writable(options.statistics);
  return files;
}

bool render_picture(const PreparedScene& prepared, const RenderOptions& asked, const PlannedFiles& planned,
                    const std::atomic<bool>& stop, UnfinishedPicture unfinished) {
  const RenderPlan plan = plan_render(prepared, asked);
  const RenderOptions& options = plan.options;
  std::vector<Output> files = planned.outputs;
  files.insert(files.end(), planned.aovs.begin(), planned.aovs.end());
  check_inputs_survive(files, options.statistics, prepared.files);

  Progress progress(options.is_quiet, plan.settings);
  progress.start(options.scene.filename().string());
  const RenderResult result = render_scene(
      prepared, plan, [&](const RenderProgress& now) { progress.update(now); }, &stop);
  progress.finish();
  if (result.was_interrupted && unfinished == UnfinishedPicture::dropped) return false;

  ImageMetadata metadata = describe_render(plan, result.film.sample_count());
  std::ranges::move(describe_ids(prepared.scene, plan.settings.aovs), std::back_inserter(metadata));
  std::vector<ImageLayer> layers = result.aovs;
  if (options.aovs.with_variance) layers.push_back(variance_layer(result.film));
  write_outputs(planned.outputs, result.film.mean(), options.display, metadata, {layers, planned.aovs});
  if (!options.statistics.empty())
    write_statistics(options.statistics, prepared.scene, plan.settings, result, prepared.times,
                     prepared.accelerator->memory_bytes());
  report(options, files, result);
  return !result.was_interrupted;
}

}  // namespace candil
