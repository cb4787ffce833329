#include "apps/check/selection.h"

#include <algorithm>
#include <string>

#include "apps/usage_error.h"

namespace candil {
namespace {

bool is_meant(const SuiteTest& test, const std::string& filter) {
  return matches_pattern(filter, test.name) || std::ranges::find(test.tags, filter) != test.tags.end();
}

bool is_wanted(const SuiteTest& test, const CheckOptions& options) {
  const bool is_named =
      options.updates.empty() || std::ranges::find(options.updates, test.name) != options.updates.end();
  return is_named && (options.filters.empty() ||
                      std::ranges::any_of(options.filters, [&](const auto& filter) { return is_meant(test, filter); }));
}

void check_names(const Suite& suite, const CheckOptions& options) {
  for (const std::string& filter : options.filters)
    if (std::ranges::none_of(suite.tests, [&](const SuiteTest& test) { return is_meant(test, filter); }))
      throw UsageError("--filter: no test has the name or tag '" + filter + "'");
  for (const std::string& name : options.updates)
    if (std::ranges::none_of(suite.tests, [&](const SuiteTest& test) { return test.name == name; }))
      throw UsageError("--update: no test has the name '" + name + "'");
}

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, retry = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++, retry = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1, t = ++retry;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::vector<const SuiteTest*> select_tests(const Suite& suite, const CheckOptions& options) {
  check_names(suite, options);
  std::vector<const SuiteTest*> wanted, part;
  for (const SuiteTest& test : suite.tests)
    if (is_wanted(test, options)) wanted.push_back(&test);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (static_cast<int>(i % static_cast<std::size_t>(options.shards)) == options.shard - 1) part.push_back(wanted[i]);
  return part;
}

}  // namespace candil
