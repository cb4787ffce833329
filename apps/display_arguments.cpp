#include "apps/display_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <functional>

#include "apps/option_values.h"
#include "apps/tonemap_choice.h"

namespace candil {
namespace {

void add(CLI::App& app, const std::string& names, const std::string& value, const std::string& help,
         const std::function<void(const std::string&)>& set) {
  app.add_option_function<std::string>(names, set, help)
      ->type_name(value)
      ->group("Output")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

PpmKind parse_ppm_kind(const std::string& text) {
  if (text == "binary") return PpmKind::binary;
  if (text == "ascii") return PpmKind::ascii;
  if (text == "hdr") return PpmKind::hdr;
  fail_choice("--ppm", text, {"binary", "ascii", "hdr"});
}

}  // namespace

void add_display_arguments(CLI::App& app, const std::string& tonemap_option, const std::string& default_words,
                           DisplayOptions& display) {
  add(app, "--exposure", "STOPS", "Brighten (or darken) display formats by factors of two",
      [&display](const std::string& text) {
        display.exposure = static_cast<float>(parse_real("--exposure", text, -64, 64));
      });
  const std::string option = tonemap_option.substr(0, tonemap_option.find(','));
  add(app, tonemap_option, "NAME[:KEY=VALUE,...]",
      fmt::format("For display formats: {} (default: {}); `candil tonemap --help` explains them",
                  fmt::join(tonemap_names(), ", "), default_words),
      [&display, option](const std::string& text) { display.tonemap = parse_tonemap(option, text); });
  add(app, "--ppm", "KIND",
      "What .ppm files hold: binary (P6, default) or ascii (P3) for display, hdr (P3 with a #MAX= line) for linear "
      "values",
      [&display](const std::string& text) { display.ppm = parse_ppm_kind(text); });
}

}  // namespace candil
