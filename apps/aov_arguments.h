/// The options of `candil render` for AOVs and the variance.
#pragma once

#include "apps/aov_outputs.h"

namespace CLI {
class App;
}

namespace candil {

/// Declares --aov, --variance and --aov-separate. Parsing fills `options`, which must outlive `app`; wrong words throw
/// UsageError while parsing.
void add_aov_arguments(CLI::App& app, AovOptions& options);

}  // namespace candil
