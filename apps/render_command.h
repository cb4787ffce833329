/// `candil render`: from a scene file to pictures.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// Returns an exit code: done or interrupted. Throws UsageError, InputError and OutputError.
int run_render(const RenderOptions& options);

}  // namespace candil
