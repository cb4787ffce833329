/// The arguments of `candil render`.
#pragma once

#include "apps/command_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares the arguments; parsing fills `options`, which must outlive it. Values out of range throw UsageError
/// while parsing.
void add_render_arguments(CLI::App& app, RenderOptions& options);

/// What only shows when all arguments are known. Throws UsageError.
void check_render_arguments(RenderOptions& options);

}  // namespace candil
