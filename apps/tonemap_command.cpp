#include "apps/tonemap_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/exit_code.h"
#include "apps/messages.h"
#include "io/image_file.h"

namespace candil {
namespace {

void warn_of_odd_values(const TonemapOptions& options, const Image& image) {
  const auto count = std::ranges::count_if(image.pixels, [](float value) { return !std::isfinite(value); });
  if (count > 0)
    print_warning(fmt::format("{}: {} values are not finite; NaN is shown black, infinity as the brightest light",
                              options.input.string(), count));
}

void warn_of_lost_alpha(std::span<const Output> outputs) {
  for (const Output& output : outputs)
    if (!output.is_standard_output() && !has_alpha_channel(output.path))
      print_warning(output.path.string() + ": the format has no alpha, the background will be black");
}

}  // namespace

int run_tonemap(const TonemapOptions& options) {
  const std::vector<Output> outputs = plan_outputs(options.outputs, options.input);
  check_input_survives(outputs, options.input);
  const Image image = read_image(options.input);
  warn_of_odd_values(options, image);
  DisplayOptions display = options.display;
  display.is_transparent = image.channels == 4;
  if (display.is_transparent) warn_of_lost_alpha(outputs);
  write_outputs(outputs, image, display, {});
  if (!options.is_quiet)
    for (const Output& output : outputs)
      print_note(fmt::format("wrote {} ({}x{})", output.is_standard_output() ? "standard output" : output.path.string(),
                             image.width, image.height));
  return exit_done;
}

}  // namespace candil
