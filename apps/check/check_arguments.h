/// The arguments of `candil check`.
#pragma once

#include "apps/command_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares the arguments; parsing fills `options`, which must outlive it. Values out of range throw UsageError while
/// parsing.
void add_check_arguments(CLI::App& app, CheckOptions& options);

/// What only shows when all arguments are known. Throws UsageError.
void complete_check_arguments(CheckOptions& options);

}  // namespace candil
