/// The options that say how linear values become files, alike for every command that writes pictures.
#pragma once

#include <string>

#include "apps/outputs.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares --exposure, `tonemap_option` (CLI11's way of naming an option: "--tonemap" or "--operator,--tonemap") and
/// --ppm. `default_words` is what the help says of the default operator. Parsing fills `display`, which must outlive
/// `app`; wrong values throw UsageError while parsing.
void add_display_arguments(CLI::App& app, const std::string& tonemap_option, const std::string& default_words,
                           DisplayOptions& display);

}  // namespace candil
