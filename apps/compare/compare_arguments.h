/// The arguments of `candil compare`.
#pragma once

#include <string_view>

#include "apps/compare/compare_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares the arguments; parsing fills `options`, which must outlive it. Wrong values throw UsageError while parsing.
void add_compare_arguments(CLI::App& app, CompareOptions& options);

/// "flip=0.1", "flip:p99=0.2", "ssim:min=0.5". Throws UsageError that names the option.
Threshold parse_threshold(std::string_view option, std::string_view text);

}  // namespace candil
