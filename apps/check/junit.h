/// Results as JUnit XML, in the form that Jenkins, GitLab and GitHub's reporters read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/check/test_outcome.h"

namespace candil {

/// Text for XML and HTML, also inside of quotes: markup is escaped, bytes that are no UTF-8 and characters that XML
/// does not know become '?'.
std::string escape_xml(std::string_view text);

/// One <testsuite> in <testsuites>; tests in the order given.
std::string junit_xml(const std::string& suite_name, const std::vector<TestOutcome>& outcomes);

}  // namespace candil
