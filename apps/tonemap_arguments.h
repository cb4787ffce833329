/// The arguments of `candil tonemap`.
#pragma once

#include "apps/command_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares the arguments; parsing fills `options`, which must outlive it. Values out of range throw UsageError
/// while parsing.
void add_tonemap_arguments(CLI::App& app, TonemapOptions& options);

}  // namespace candil
