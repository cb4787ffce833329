/// `candil check --update`: makes golden images anew.
#pragma once

#include "apps/check/test_outcome.h"
#include "apps/command_options.h"

namespace candil {

/// Says what will change, then writes. A golden image stays as it is, byte for byte, when the render passed and was
/// made of the same scene files with the same options. A test that was not rendered to its end is never updated.
/// Returns how many tests could not be. Throws OutputError.
std::size_t update_goldens(const std::vector<TestOutcome>& outcomes, const CheckOptions& options,
                           const std::atomic<bool>& interrupted);

}  // namespace candil
