/// Results as JUnit XML, in the form that Jenkins, GitLab and GitHub's reporters read.
#pragma once

#include <string>
#include <vector>

#include "apps/check/test_outcome.h"

namespace candil {

/// One <testsuite> in <testsuites>; tests in the order given.
std::string junit_xml(const std::string& suite_name, const std::vector<TestOutcome>& outcomes);

}  // namespace candil
