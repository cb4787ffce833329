#include "apps/check/failure_page.h"

#include <fmt/format.h>

#include "apps/compare/compare_report.h"
#include "metrics/map_statistics.h"

namespace candil {

bool has_failure_page(const TestOutcome& outcome) {
  return outcome.is_failure() && outcome.verdict && outcome.verdict->flip_map;
}

std::string failure_page(const TestOutcome& outcome) {
  const Verdict& verdict = *outcome.verdict;
  const Image &golden = outcome.golden->mean, &render = outcome.render->image.mean;
  Report report;
  report.title = outcome.test->name;
  report.name_a = outcome.test->golden.string();
  report.name_b = "render of " + outcome.test->name;
  report.verdict = outcome.message;
  report.notes = verdict.notes;
  report.notes.push_back("Reproduce: " + outcome.reproduce);
  if (outcome.status == TestStatus::failed)
    report.notes.push_back("If the new picture is the right one: " + outcome.bless);
  constexpr int bins = 128;
  const PixelSelection all(golden.width, golden.height);
  std::vector<std::string> channels = {"R", "G", "B"};
  if (golden.channels == 4) channels.emplace_back("A");
  report.layers.push_back({"", std::move(channels), ValueKind::linear, false, golden, render, *verdict.flip_map, "FLIP",
                           1, map_histogram(*verdict.flip_map, all, 0, 1, bins)});
  std::vector<ReportRow>& rows = report.rows.emplace_back();
  for (const Finding& finding : verdict.findings)
    rows.push_back({finding.name,
                    fmt::format("{} ({} {:.4g})", value_text(finding), finding.is_smallest ? "at least" : "at most",
                                finding.limit),
                    !finding.is_met});
  rows.push_back({"brightness", fmt::format("{:+.3f} %", 100 * verdict.mean_change), false});
  return make_report(report);
}

std::filesystem::path failure_page_path(const std::string& test_name) {
  return std::filesystem::path("compare") / (test_name + ".html");
}

}  // namespace candil
