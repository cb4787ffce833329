#include "apps/render_steps.h"

#include <chrono>
#include <utility>

#include "apps/file_defaults.h"
#include "apps/versions.h"
#include "core/accelerator.h"
#include "io/image_file.h"
#include "materials/alpha.h"

namespace candil {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void load(const RenderOptions& options, PreparedScene& prepared) {
  LoadedScene loaded = load_scene(options.scene, options.load);
  prepared.warnings = std::move(loaded.warnings);
  prepared.scene = std::move(loaded.scene);
  prepared.files = std::move(loaded.files);
  if (!options.environment.image.empty()) prepared.files.push_back(options.environment.image);
  prepared.scene.environment = choose_environment(prepared.scene, options.environment, loaded.is_lit);
  prepared.defaults = std::move(loaded.render_defaults);
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
  auto prepared = std::make_unique<PreparedScene>();
  const Clock::time_point start = Clock::now();
  load(options, *prepared);
  prepared->lights = std::make_unique<LightSampler>(prepared->scene);
  if (prepared->lights->is_empty())
    prepared->warnings.push_back(options.scene.string() + ": no light, the picture will be black");
  prepared->tables = std::make_unique<BsdfTables>(prepared->scene);
  prepared->times.load = seconds_since(start);
  const Clock::time_point bvh_start = Clock::now();
  prepared->accelerator = make_accelerator(prepared->scene, alpha_filter(), options.accelerator);
  prepared->times.bvh = seconds_since(bvh_start);
  return prepared;
}

RenderPlan plan_render(const PreparedScene& prepared, const RenderOptions& asked) {
  RenderPlan plan;
  plan.options = with_file_defaults(asked, prepared.defaults);
  plan.camera = choose_camera(prepared.scene, plan.options.camera, plan.options.size);
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
