#include "apps/file_defaults.h"

#include "apps/render_arguments.h"
#include "apps/tonemap_choice.h"
#include "apps/usage_error.h"
#include "io/error.h"

namespace candil {
namespace {

/// Not a view of normals and the like.
bool is_picture(IntegratorKind kind) { return kind != IntegratorKind::normals && kind != IntegratorKind::albedo; }

/// Only what the command line leaves open.
void take_from_file(RenderOptions& options, const RenderDefaults& defaults) {
  const auto is_open = [&](const char* option) { return !options.given.contains(option); };
  const auto take = [&](const char* option, const auto& value, auto& target) {
    if (value && is_open(option)) target = *value;
  };
  RenderSettings& settings = options.settings;
  if (defaults.size && is_open("--size")) options.size = ImageSize{(*defaults.size)[0], (*defaults.size)[1]};
  // A time limit takes as many samples as fit.
  if (settings.time_limit_seconds == 0) take("--spp", defaults.samples_per_pixel, settings.samples_per_pixel);
  take("--max-bounces", defaults.max_bounces, settings.max_bounces);
  take("--seed", defaults.seed, settings.seed);
  take("--exposure", defaults.exposure, options.display.exposure);
  if (defaults.integrator && is_open("--integrator"))
    settings.integrator = parse_integrator("render.integrator", *defaults.integrator);
  if (defaults.filter && is_open("--filter")) settings.filter = parse_filter("render.filter", *defaults.filter);
  // What suits a picture does not suit a view of normals.
  if (defaults.tonemap && is_open("--tonemap") && is_picture(settings.integrator))
    options.display.tonemap = parse_tonemap("render.tonemap", *defaults.tonemap);
}

}  // namespace

RenderOptions with_file_defaults(const RenderOptions& options, const RenderDefaults& defaults) {
  RenderOptions settled = options;
  try {
    take_from_file(settled, defaults);
  } catch (const UsageError& error) {
    throw InputError(options.scene.string(), "", error.what());
  }
  RenderSettings& settings = settled.settings;
  constexpr std::uint32_t default_samples = 64;
  if (settings.samples_per_pixel == 0)
    settings.samples_per_pixel = settings.time_limit_seconds > 0 ? max_samples : default_samples;
  if (!settled.display.tonemap)
    settled.display.tonemap = make_tonemap(is_picture(settings.integrator) ? TonemapKind::neutral : TonemapKind::none);
  return settled;
}

}  // namespace candil
