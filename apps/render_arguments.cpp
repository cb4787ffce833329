#include "apps/render_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "apps/accelerator_argument.h"
#include "apps/aov_arguments.h"
#include "apps/arguments.h"
#include "apps/display_arguments.h"
#include "apps/messages.h"
#include "apps/scene_arguments.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

constexpr const char* footer = R"(
Examples:
  candil model.glb                                   model.png, framed and lit automatically
  candil model.glb -o a.png -o a.exr --spp 512       a picture and its linear values
  candil model.glb -o a.exr --aov depth,normals      layers R, G, B, depth.Z, normals.X, .Y, .Z
  candil model.glb --env sky.hdr --env-rotate 90     lit by an environment image
  candil model.glb --orbit 120,10 --size 800x800     from another side
  candil model.glb --look-from 2,1,3 --look-at 0,1,0 --fov 40 --aperture 0.02 --focus 3
  candil model.glb --transparent -o cut-out.png      without background
  candil model.glb --time 30 --stats stats.json      what 30 seconds give
  candil model.glb --animation Walk --at 0.5         a still out of an animation
  candil model.glb --frames 0-47 --fps 24 -o walk_{:04}.png
  candil model.glb -o - --quiet | display            PNG to standard output

Ctrl-C writes what is there; pressed again, it ends the program at once.)";

constexpr double farthest = 1e9;  // metres, as in scene files

float parse_radians(const std::string& option, const std::string& text, double low, double high) {
  return glm::radians(static_cast<float>(parse_real(option, text, low, high)));
}

float parse_float(const std::string& option, const std::string& text, double low, double high) {
  return static_cast<float>(parse_real(option, text, low, high));
}

void add_sampling_arguments(Arguments& arguments, RenderSettings& settings) {
  arguments.group("Quality");
  arguments.add("--spp", "N", "Samples per pixel (default 64; with --time as many as fit)",
                [&](const auto& option, const auto& text) {
                  settings.samples_per_pixel = static_cast<std::uint32_t>(parse_integer(option, text, 1, max_samples));
                });
  arguments.add(
      "--time", "SECONDS", "Stop after this time and write what is there",
      [&](const auto& option, const auto& text) { settings.time_limit_seconds = parse_real(option, text, 1e-3, 1e9); });
  arguments.add("--max-bounces", "N", "Longest paths, in scattering events (default 64)",
                [&](const auto& option, const auto& text) {
                  settings.max_bounces = static_cast<std::uint32_t>(parse_integer(option, text, 0, 65535));
                });
  arguments.add("--integrator", "NAME", "path (default), naive, classic, normals or albedo",
                [&](const auto& option, const auto& text) { settings.integrator = parse_integrator(option, text); });
  arguments.add("--filter", "NAME", "Pixel filter: blackman-harris (default), box or gaussian",
                [&](const auto& option, const auto& text) { settings.filter = parse_filter(option, text); });
  arguments.add("--seed", "N", "Another seed, other noise (default 0)", [&](const auto& option, const auto& text) {
    settings.seed = parse_integer(option, text, 0, ~std::uint64_t{0});
  });
  arguments.add("--threads", "N", "Threads (default: one for each processor); the picture is the same",
                [&](const auto& option, const auto& text) {
                  settings.threads = static_cast<int>(parse_integer(option, text, 1, 1024));
                });
}

void add_accelerator_argument(Arguments& arguments, AcceleratorOptions& accelerator) {
  arguments.group("Quality");
  arguments.add("--accel", "NAME", accelerator_help,
                [&](const auto& option, const auto& text) { accelerator = parse_accelerator(option, text); });
}

void add_sequence_arguments(Arguments& arguments, RenderOptions& options) {
  arguments.group("Scene");
  arguments.add("--frames", "A-B",
                "A picture for each of these frames of the animation; {:04} or %04d in the names of files is the "
                "frame's number (default: _0001 at their end)",
                [&](const auto& option, const auto& text) { options.frames = parse_frames(option, text); });
  arguments.add(
      "--fps", "N", "Frames per second (default 24): frame k is at k/N seconds",
      [&](const auto& option, const auto& text) { options.frames_per_second = parse_real(option, text, 1e-3, 1e6); });
}

void add_camera_arguments(Arguments& arguments, CameraOptions& camera) {
  arguments.group("Camera");
  CLI::Option* const name = arguments.add("--camera", "INDEX|NAME", "A camera of the file (default: the first)",
                                          [&](const auto&, const auto& text) { camera.name = text; });
  CLI::Option* const orbit = arguments.add(
      "--orbit", "AZIMUTH,ELEVATION[,DISTANCE]",
      "Look at the middle of the scene; degrees and metres (default 35,20, at the distance that fills the frame)",
      [&](const auto& option, const auto& text) {
        const std::vector<float> values = parse_reals(option, text, 2, 3, farthest);
        Orbit wanted{glm::radians(values[0]), glm::radians(values[1])};
        if (values.size() == 3) wanted.distance = values[2];
        if (values.size() == 3 && !(values[2] > 0)) throw UsageError(option + ": the distance must be positive");
        camera.orbit = wanted;
      });
  CLI::Option* const from = arguments.add(
      "--look-from", "X,Y,Z", "Stand here, in metres",
      [&](const auto& option, const auto& text) { camera.look_from = parse_vector(option, text, farthest); });
  arguments
      .add("--look-at", "X,Y,Z", "Look at this point (default: the middle of the scene)",
           [&](const auto& option, const auto& text) { camera.look_at = parse_vector(option, text, farthest); })
      ->needs(from);
  name->excludes(orbit)->excludes(from);
  orbit->excludes(from);
  arguments.add("--fov", "DEGREES", "Vertical angle of view",
                [&](const auto& option, const auto& text) { camera.yfov = parse_radians(option, text, 0.01, 179); });
  arguments.add("--aperture", "METRES", "Radius of the lens; 0 is a pinhole (default)",
                [&](const auto& option, const auto& text) { camera.lens_radius = parse_float(option, text, 0, 1e6); });
  arguments.add(
      "--focus", "METRES", "Distance in focus (default: the middle of the scene, or --look-at)",
      [&](const auto& option, const auto& text) { camera.focus_distance = parse_float(option, text, 1e-6, 1e12); });
}

void add_light_arguments(Arguments& arguments, EnvironmentOptions& environment) {
  arguments.group("Environment");
  CLI::Option* const image = arguments.add("--env", "FILE", "Light from a latitude-longitude image: .hdr, .exr, .pfm",
                                           [&](const auto&, const auto& text) { environment.image = text; });
  arguments
      .add("--env-color", "R,G,B",
           "The same light from everywhere; 0,0,0 for none (default: a studio, if the file has no light)",
           [&](const auto& option, const auto& text) {
             const Vec3 color = parse_vector(option, text, 1e30);
             if (min_component(color) < 0) throw UsageError(option + ": light must not be negative");
             environment.color = color;
           })
      ->excludes(image);
  arguments.add(
      "--env-rotate", "DEGREES", "Turn the environment about the vertical axis",
      [&](const auto& option, const auto& text) { environment.rotation = parse_radians(option, text, -1e6, 1e6); });
  arguments.add(
      "--env-strength", "X", "Factor of the environment's light (default 1)",
      [&](const auto& option, const auto& text) { environment.strength = parse_float(option, text, 0, 1e12); });
}

void add_output_arguments(CLI::App& app, Arguments& arguments, RenderOptions& options) {
  arguments.group("Output");
  app.add_option(
         "-o,--output", options.outputs,
         "Image file: .png .jpg .tif .ppm (display) or .exr .hdr .pfm (linear); - is a PNG on standard output. May be "
         "given several times (default: a PNG named after the scene)")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->group("Output");
  arguments.add("--size", "WxH",
                "Pixels (default: 1024 on the longer side, as the camera of the file wants, or 1024x768)",
                [&](const auto& option, const auto& text) { options.size = parse_size(option, text); });
  arguments.add_flag("--transparent", "Leave the background out: alpha in .png .tif .exr",
                     options.display.is_transparent);
  add_aov_arguments(app, options.aovs);
  add_display_arguments(app, "--tonemap", "neutral; none for normals and albedo", options.display);
  arguments.add("--stats", "FILE", "Write times, counts and versions as JSON",
                [&](const auto&, const auto& text) { options.statistics = text; });
  arguments.add_flag("--quiet,-q", "No progress and no list of files; warnings and errors stay", options.is_quiet);
}

}  // namespace

IntegratorKind parse_integrator(std::string_view option, std::string_view text) {
  const std::optional<IntegratorKind> kind = integrator_from_name(text);
  if (!kind) fail_choice(option, text, {"path", "naive", "classic", "normals", "albedo"});
  return *kind;
}

FilterKind parse_filter(std::string_view option, std::string_view text) {
  const std::optional<FilterKind> kind = filter_from_name(text);
  if (!kind) fail_choice(option, text, {"blackman-harris", "box", "gaussian"});
  return *kind;
}

void add_render_options(CLI::App& app, RenderOptions& options) {
  constexpr std::uint32_t not_given = 0;
  options.settings.samples_per_pixel = not_given;
  Arguments arguments(app);
  add_output_arguments(app, arguments, options);
  add_sampling_arguments(arguments, options.settings);
  add_accelerator_argument(arguments, options.accelerator);
  add_scene_arguments(arguments, options.load);
  add_sequence_arguments(arguments, options);
  add_camera_arguments(arguments, options.camera);
  add_light_arguments(arguments, options.environment);
}

void add_render_arguments(CLI::App& app, RenderOptions& options) {
  app.add_option_function<std::string>(
         "SCENE", [&](const std::string& text) { options.scene = text; }, "Scene file: .gltf, .glb, .ply or .json")
      ->required();
  add_render_options(app, options);
  app.footer(footer);
}

void check_render_arguments(RenderOptions& options) {
  if (options.aovs.is_separate && options.aovs.list.empty() && !options.aovs.with_variance)
    throw UsageError("--aov-separate needs --aov or --variance");
  if (options.frames && options.load.at) throw UsageError("--at is a still, --frames a sequence: give one of them");
  if (!options.frames && options.given.contains("--fps")) throw UsageError("--fps needs --frames");
  RenderSettings& settings = options.settings;
  if (settings.threads == 0) settings.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void note_given_options(const CLI::App& app, RenderOptions& options) {
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0) options.given.insert(option->get_name());
}

RenderOptions parse_render_words(const std::vector<std::string>& words) {
  RenderOptions options;
  CLI::App app;
  app.set_help_flag("");
  add_render_arguments(app, options);
  std::vector<std::string> reversed(words.rbegin(), words.rend());  // the order in which CLI11 takes them
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error.what()));
  }
  note_given_options(app, options);
  check_render_arguments(options);
  return options;
}

}  // namespace candil
