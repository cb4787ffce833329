/// The arguments of `candil fidelity`.
#pragma once

#include "apps/command_options.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares the arguments, those of a render among them; parsing fills `options`, which must outlive it. Values out of
/// range throw UsageError while parsing.
void add_fidelity_arguments(CLI::App& app, FidelityOptions& options);

}  // namespace candil
