#include "apps/check/test_outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace candil {
namespace {

int rank(TestStatus status) {
  switch (status) {
    case TestStatus::broken:
      return 0;
    case TestStatus::failed:
      return 1;
    case TestStatus::not_run:
      return 2;
    default:
      return 3;
  }
}

double severity(const TestOutcome& outcome) {
  return outcome.verdict ? outcome.verdict->severity() : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string value_text(const Finding& finding) {
  if (finding.log10_value < -300) return fmt::format("1e{:.0f}", finding.log10_value);
  return fmt::format("{:.3g}", finding.value);
}

std::string describe_findings(const Verdict& verdict, bool only_failed) {
  std::string text;
  for (const Finding& finding : verdict.findings) {
    if (only_failed && finding.is_met) continue;
    if (!text.empty()) text += ", ";
    text += finding.name + " " + value_text(finding);
    if (only_failed) text += fmt::format(" ({} {:.3g})", finding.is_smallest ? "at least" : "at most", finding.limit);
  }
  return text;
}

std::vector<const TestOutcome*> by_severity(const std::vector<TestOutcome>& outcomes) {
  std::vector<const TestOutcome*> sorted;
  for (const TestOutcome& outcome : outcomes) sorted.push_back(&outcome);
  std::ranges::stable_sort(sorted, [](const TestOutcome* a, const TestOutcome* b) {
    if (rank(a->status) != rank(b->status)) return rank(a->status) < rank(b->status);
    return a->is_failure() && severity(*a) > severity(*b);
  });
  return sorted;
}

}  // namespace candil
