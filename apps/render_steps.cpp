#include "apps/render_steps.h"

#include <chrono>
#include <utility>

#include "apps/file_defaults.h"
#include "apps/kept_accelerator.h"
#include "apps/versions.h"
#include "core/accelerator.h"
#include "io/image_file.h"
#include "materials/alpha.h"

namespace candil {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Everything but the scene itself.
void take_over(const RenderOptions& options, LoadedScene& loaded, PreparedScene& prepared) {
  prepared.warnings = std::move(loaded.warnings);
  prepared.files = std::move(loaded.files);
  if (!options.environment.image.empty()) prepared.files.push_back(options.environment.image);
  prepared.defaults = std::move(loaded.render_defaults);
}

/// All that is made of the scene but the accelerator.
void add_tables(const RenderOptions& options, PreparedScene& prepared) {
  if (prepared.scene.instances.empty() && prepared.scene.shapes.empty())
    prepared.warnings.push_back(options.scene.string() +
                                ": no surface is in the scene, the picture shows the background");
  prepared.lights = std::make_unique<LightSampler>(prepared.scene);
  if (prepared.lights->is_empty())
    prepared.warnings.push_back(options.scene.string() + ": no light, the picture will be black");
  prepared.tables = std::make_unique<BsdfTables>(prepared.scene);
}

void add_accelerator(const RenderOptions& options, PreparedScene& prepared) {
  const Clock::time_point start = Clock::now();
  prepared.accelerator = make_accelerator(prepared.scene, alpha_filter(), options.accelerator);
  prepared.times.bvh = seconds_since(start);
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

}  // namespace

std::unique_ptr<PreparedScene> prepare_scene(const RenderOptions& options) {
  if (options.load.is_animated() && is_gltf_scene(options.scene)) {
    SceneSequence sequence(options.scene, options.load);
    return prepare_frame(options, sequence, nullptr);
  }
  auto prepared = std::make_unique<PreparedScene>();
  const Clock::time_point start = Clock::now();
  LoadedScene loaded = load_scene(options.scene, options.load);
  take_over(options, loaded, *prepared);
  prepared->scene = std::move(loaded.scene);
  prepared->scene.environment = choose_environment(prepared->scene, options.environment, loaded.is_lit);
  add_tables(options, *prepared);
  prepared->times.load = seconds_since(start);
  add_accelerator(options, *prepared);
  return prepared;
}

std::unique_ptr<PreparedScene> prepare_frame(const RenderOptions& options, SceneSequence& sequence,
                                             std::unique_ptr<PreparedScene> previous) {
  const Clock::time_point start = Clock::now();
  const bool is_first = previous == nullptr;
  std::unique_ptr<PreparedScene> prepared = is_first ? std::make_unique<PreparedScene>() : std::move(previous);
  Scene images;
  std::swap(images.images, prepared->scene.images);
  sequence.recycle(std::move(images));
  LoadedScene loaded = sequence.at(options.load.at.value_or(0));
  take_over(options, loaded, *prepared);
  Scene& next = loaded.scene;
  if (is_camera_automatic(next, options.camera)) prepared->outline = sequence.motion().outline;
  if (!is_first && !options.environment.image.empty()) {
    next.environment = std::move(prepared->scene.environment);  // the same at any time
  } else {
    // The studio must not go on and off with the lights of the file.
    const bool is_lit = loaded.is_lit || has_light(next);
    const bool is_asked = !options.environment.image.empty() || options.environment.color;
    next.environment =
        choose_environment(next, options.environment, is_lit || (!is_asked && sequence.motion().has_light));
  }
  const bool is_still = !is_first && has_same_geometry(prepared->scene, next);
  if (is_still) {
    replace_scene(*prepared, std::move(next));
  } else {
    prepared->accelerator.reset();  // before the scene that it looks at
    prepared->scene = std::move(next);
  }
  add_tables(options, *prepared);
  prepared->times.load = seconds_since(start);
  prepared->times.bvh = 0;
  if (!is_still) add_accelerator(options, *prepared);
  return prepared;
}

RenderPlan plan_render(const PreparedScene& prepared, const RenderOptions& asked) {
  RenderPlan plan;
  plan.options = with_file_defaults(asked, prepared.defaults);
  plan.camera = choose_camera(prepared.scene, plan.options.camera, plan.options.size, prepared.outline);
  plan.settings = plan.options.settings;
  plan.settings.width = plan.camera.size.width, plan.settings.height = plan.camera.size.height;
  plan.settings.transparent_background = plan.options.display.is_transparent;
  plan.settings.aovs = plan.options.aovs.list;
  return plan;
}

RenderResult render_scene(const PreparedScene& prepared, const RenderPlan& plan,
                          const std::function<void(const RenderProgress&)>& on_progress,
                          const std::atomic<bool>* stop) {
  const RenderContext context{prepared.scene, *prepared.accelerator, *prepared.lights, *prepared.tables};
  return render(context, plan.camera.camera, plan.settings, on_progress, stop);
}

ImageMetadata describe_render(const RenderPlan& plan, std::uint32_t samples) {
  return {{"candil:version", candil_version()},
          {"candil:scene", plan.options.scene.filename().string()},
          {"candil:camera", plan.camera.description},
          {"candil:integrator", integrator_name(plan.settings.integrator)},
          {"candil:seed", std::to_string(plan.settings.seed)},
          {"candil:spp", std::to_string(samples)}};
}

}  // namespace candil
