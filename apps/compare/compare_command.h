/// `candil compare`: what differs between two images, in numbers and to look at.
#pragma once

#include "apps/compare/compare_options.h"

namespace candil {

/// Returns exit_done or exit_difference. Throws UsageError, InputError or OutputError.
int run_compare(const CompareOptions& options);

}  // namespace candil
