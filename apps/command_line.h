/// From the words of the command line to options.
#pragma once

#include <string>
#include <variant>

#include "apps/command_options.h"
#include "apps/compare/compare_options.h"

namespace candil {

/// Help or version: goes to standard output as it is.
struct PrintText {
  std::string text;
};

using Command = std::variant<RenderOptions, TonemapOptions, CompareOptions, InfoOptions, BenchOptions, CheckOptions,
                             FidelityOptions, PrintText>;

/// `render` may be left out. Throws UsageError.
Command parse_command_line(int argc, const char* const* argv);

}  // namespace candil
