#include "apps/fidelity_command.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "apps/fidelity_scenario.h"
#include "apps/render_command.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

/// The harness' browsers show the columns of an environment image from +X on; the middle one looks along +X (equirectUv
/// of three.js, and Blender's). Ours looks along -Z: a quarter to the right.
constexpr float lighting_rotation = -0.5f * pi;

/// All renderers of the suite agree on the ACES curve of three.js: Hill's, of the radiance over 0.6.
const float exposure_stops = static_cast<float>(-std::log2(0.6));

ImageSize picture_size(const Scenario& scenario, double pixel_ratio) {
  const auto pixels = [&](double length) {
    const double count = std::round(length * pixel_ratio);
    if (count > max_image_side) throw UsageError("--pixel-ratio: the picture would be wider than 32768 pixels");
    return std::max(1, static_cast<int>(count));
  };
  return {pixels(scenario.width), pixels(scenario.height)};
}

/// Only what the command line leaves open.
RenderOptions with_scenario(RenderOptions options, const Scenario& scenario, double pixel_ratio) {
  const auto is_open = [&](std::initializer_list<const char*> names) {
    return std::ranges::none_of(names, [&](const char* name) { return options.given.contains(name); });
  };
  options.scene = scenario.model;
  if (options.outputs.empty() && !scenario.output.empty()) options.outputs = {scenario.output.string()};
  if (is_open({"--size"})) options.size = picture_size(scenario, pixel_ratio);
  if (is_open({"--camera", "--orbit", "--look-from"})) {
    options.camera.look_from = Vec3(scenario.eye());
    options.camera.look_at = Vec3(scenario.aim());
  }
  if (is_open({"--fov"})) options.camera.yfov = glm::radians(static_cast<float>(scenario.vertical_fov));
  if (is_open({"--env", "--env-color"}) && !scenario.lighting.empty()) {
    options.environment.image = scenario.lighting.string();
    if (is_open({"--env-rotate"})) options.environment.rotation = lighting_rotation;
  }
  if (!scenario.has_skybox) options.display.is_transparent = true;
  if (is_open({"--tonemap"})) options.display.tonemap = make_tonemap(TonemapKind::aces);
  if (is_open({"--tonemap", "--exposure"})) options.display.exposure = exposure_stops;
  if (is_open({"--spp", "--time"}) && scenario.samples) options.settings.samples_per_pixel = *scenario.samples;
  return options;
}

}  // namespace

int run_fidelity(const FidelityOptions& options) {
  const Scenario scenario = read_scenario(options.scenario, options.base);
  return run_render(with_scenario(options.render, scenario, options.pixel_ratio));
}

}  // namespace candil
