/// `candil info`: what is in a scene, what is unsupported, what looks wrong.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// Prints to standard output; returns an exit code. Throws InputError.
int run_info(const InfoOptions& options);

}  // namespace candil
