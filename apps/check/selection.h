/// Which tests of a suite are wanted.
#pragma once

#include <string_view>
#include <vector>

#include "apps/check/suite.h"
#include "apps/command_options.h"

namespace candil {

/// `pattern` with '*' for any text, also none.
bool matches_pattern(std::string_view pattern, std::string_view text);

/// In the order of the suite. Filters first, then the shard: every test is in exactly one of them. Throws UsageError
/// for a filter or a name of --update that no test has.
std::vector<const SuiteTest*> select_tests(const Suite& suite, const CheckOptions& options);

}  // namespace candil
