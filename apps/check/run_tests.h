/// Renders the tests of a suite, several at a time, and judges each.
#pragma once

#include <functional>

#include "apps/check/result_store.h"
#include "apps/check/test_outcome.h"
#include "apps/command_options.h"

namespace candil {

/// One outcome for each test, in their order. `on_done` is called after each, from one thread at a time; what it throws
/// ends the run.
std::vector<TestOutcome> run_tests(const std::vector<const SuiteTest*>& tests, const CheckOptions& options,
                                   const std::atomic<bool>& interrupted, const ResultStore& store,
                                   const std::function<void(const TestOutcome&)>& on_done);

/// What a result depends on beside files: options, thresholds, overrides.
std::string settings_text(const SuiteTest& test, const CheckOptions& options);

}  // namespace candil
