/// `candil bench`: accelerators side by side on the rays of a render.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// Returns an exit code: exit_difference when the answers of two accelerators differ. Throws UsageError, InputError or
/// OutputError.
int run_bench(const BenchOptions& options);

}  // namespace candil
