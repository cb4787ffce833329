/// `candil tonemap`: an image of linear values to what a display shows.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// Returns an exit code. Throws UsageError, InputError or OutputError.
int run_tonemap(const TonemapOptions& options);

}  // namespace candil
