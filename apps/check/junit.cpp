#include "apps/check/junit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace candil {
namespace {

/// Bytes of the UTF-8 character at `i` that XML 1.0 allows (section 2.2); 0 for none.
std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) -> std::uint32_t {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
  };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  std::uint32_t code = first & (0x7fu >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(k) & 0x3f);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_character = code >= least[length] && code <= 0x10ffff && !(code >= 0xd800 && code <= 0xdfff) &&
                            code != 0xfffe && code != 0xffff;
  return is_character ? length : 0;
}

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

std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      escaped += '?';
      ++i;
      continue;
    }
    switch (text[i]) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += text.substr(i, length);
    }
    i += length;
  }
  return escaped;
}

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
