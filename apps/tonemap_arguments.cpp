#include "apps/tonemap_arguments.h"

#include <CLI/CLI.hpp>

#include "apps/display_arguments.h"
#include "apps/tonemap_choice.h"

namespace candil {
namespace {

constexpr const char* notes = R"(
The operator sees linear values times 2^STOPS; what it measures in the image (the largest value, averages), it measures
before the exposure. The sRGB curve follows, but for gamma, clamp-gamma and agx, whose values are stored as they are;
clamp-gamma:gamma=1 stores plain proportions. Outputs of linear formats get the input's values as they are.

Examples:
  candil tonemap sky.hdr                                    sky.png, Khronos PBR Neutral
  candil tonemap room.exr -o room.png --operator agx --exposure 1.5
  candil tonemap room.exr -o room.jpg --operator reinhard02:key=0.3,white=4
  candil tonemap room.exr -o room.jpg --operator reinhard05:contrast=1,light=0     less flat than its default
  candil tonemap room.exr -o - --operator gamma:gamma=2.4 | display
  candil tonemap room.exr -o room.ppm --ppm hdr             linear values as text
  candil tonemap room.ppm -o room.exr                       another format, the same values)";

}  // namespace

void add_tonemap_arguments(CLI::App& app, TonemapOptions& options) {
  app.add_option_function<std::string>(
         "INPUT", [&](const std::string& text) { options.input = text; },
         "Image of linear values: .exr .hdr .pfm, .ppm with #MAX=, float .tif; others (.png .jpg .tif .ppm .webp) are "
         "taken as sRGB")
      ->required();
  app.add_option("-o,--output", options.outputs,
                 "Image file: .png .jpg .tif .ppm (display) or .exr .hdr .pfm (linear); - is a PNG on standard output. "
                 "May be given several times (default: a PNG named after the input)")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->group("Output");
  add_display_arguments(app, "--operator,--tonemap", "neutral", options.display);
  app.add_flag("--quiet,-q", options.is_quiet, "No list of files; warnings and errors stay")->group("Output");
  app.footer("\nOperators and their parameters:\n" + tonemap_help() + notes);
}

}  // namespace candil
