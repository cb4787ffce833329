/// What became of a test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/check/judge.h"
#include "apps/check/suite.h"
#include "apps/check/test_render.h"

namespace candil {

enum class TestStatus {
  passed,
  passed_before,  ///< Left out, by --resume.
  failed,         ///< Not like its golden image, or there is none.
  broken,         ///< Could not be rendered or compared.
  not_run         ///< Interrupted.
};

struct TestOutcome {
  const SuiteTest* test = nullptr;
  TestStatus status = TestStatus::not_run;
  std::string message;  ///< Of what is not passed: one line.
  std::vector<std::string> warnings;
  double seconds = 0;
  std::optional<TestRender> render;
  std::optional<GoldenImage> golden;
  std::optional<Verdict> verdict;
  std::string reproduce, bless;  ///< Command lines.
  std::string key;               ///< What a result depends on; the same key, the same result.

  bool is_passed() const { return status == TestStatus::passed || status == TestStatus::passed_before; }
  bool is_failure() const { return status == TestStatus::failed || status == TestStatus::broken; }
};

/// "0.031"; "1e-592" for what no double holds.
std::string value_text(const Finding& finding);

/// "ztest 1.2e-31 (at least 1e-06), flip 0.03 (at most 0.05)": those that are not met, or all.
std::string describe_findings(const Verdict& verdict, bool only_failed);

/// Failures first, the worst of them first; then what was not run, then what passed.
std::vector<const TestOutcome*> by_severity(const std::vector<TestOutcome>& outcomes);

}  // namespace candil
