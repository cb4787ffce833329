#include "apps/check/junit.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/escape_xml.h"

namespace candil {
namespace {

std::size_t count(const std::vector<TestOutcome>& outcomes, TestStatus status) {
  return static_cast<std::size_t>(std::ranges::count(outcomes, status, &TestOutcome::status));
}

std::string details(const TestOutcome& outcome) {
  std::string text = outcome.message + "\n";
  if (outcome.verdict) {
    text += describe_findings(*outcome.verdict, false) + "\n";
    for (const std::string& note : outcome.verdict->notes) text += note + "\n";
  }
  return text + "reproduce: " + outcome.reproduce + "\n";
}

std::string test_case(const std::string& suite_name, const TestOutcome& outcome) {
  const std::string open = fmt::format("    <testcase name=\"{}\" classname=\"{}\" time=\"{:.3f}\"",
                                       escape_xml(outcome.test->name), escape_xml(suite_name), outcome.seconds);
  const auto element = [&](const char* name) {
    return fmt::format("{0}>\n      <{1} message=\"{2}\" type=\"{1}\">{3}</{1}>\n    </testcase>\n", open, name,
                       escape_xml(outcome.message), escape_xml(details(outcome)));
  };
  switch (outcome.status) {
    case TestStatus::failed:
      return element("failure");
    case TestStatus::broken:
      return element("error");
    case TestStatus::not_run:
      return open + ">\n      <skipped message=\"interrupted\"/>\n    </testcase>\n";
    case TestStatus::passed:
    case TestStatus::passed_before:
      break;
  }
  if (!outcome.verdict) return open + "/>\n";
  return fmt::format("{}>\n      <system-out>{}</system-out>\n    </testcase>\n", open,
                     escape_xml(describe_findings(*outcome.verdict, false)));
}

}  // namespace

std::string junit_xml(const std::string& suite_name, const std::vector<TestOutcome>& outcomes) {
  double seconds = 0;
  for (const TestOutcome& outcome : outcomes) seconds += outcome.seconds;
  const std::string counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"", outcomes.size(),
                  count(outcomes, TestStatus::failed), count(outcomes, TestStatus::broken),
                  count(outcomes, TestStatus::not_run), seconds);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  xml += fmt::format("  <testsuite name=\"{}\" {}>\n", escape_xml(suite_name), counts);
  for (const TestOutcome& outcome : outcomes) xml += test_case(suite_name, outcome);
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace candil
