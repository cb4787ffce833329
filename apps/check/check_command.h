/// `candil check SUITE`.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// The exit code.
int run_check(const CheckOptions& options);

}  // namespace candil
