/// `candil fidelity`: a picture as the Khronos render fidelity harness wants it.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// Returns an exit code, as run_render(). Throws UsageError, InputError and OutputError.
int run_fidelity(const FidelityOptions& options);

}  // namespace candil
