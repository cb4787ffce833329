#include "apps/check/check_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "apps/check/check_report.h"
#include "apps/check/failure_files.h"
#include "apps/check/junit.h"
#include "apps/check/run_tests.h"
#include "apps/check/selection.h"
#include "apps/check/suite_file.h"
#include "apps/check/update_goldens.h"
#include "apps/exit_code.h"
#include "apps/interrupt.h"
#include "apps/messages.h"
#include "io/atomic_file.h"
#include "io/error.h"

namespace candil {
namespace {

namespace fs = std::filesystem;

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void make_folder(const fs::path& folder) {
  std::error_code status;
  fs::create_directories(folder, status);
  if (status) throw OutputError(folder.string(), "cannot be made: " + status.message());
}

const char* status_word(TestStatus status) {
  switch (status) {
    case TestStatus::passed:
      return "ok";
    case TestStatus::passed_before:
      return "ok before";
    case TestStatus::failed:
      return "FAILED";
    case TestStatus::broken:
      return "ERROR";
    case TestStatus::not_run:
      return "not run";
  }
  return "";
}

std::string outcome_line(const TestOutcome& outcome, bool is_update) {
  const bool is_change = is_update && outcome.status == TestStatus::failed;
  const std::string numbers = outcome.verdict ? describe_findings(*outcome.verdict, false) : "";
  return fmt::format("{:<9} {:<32} {:6.2f} s  {}\n", is_change ? "changed" : status_word(outcome.status),
                     outcome.test->name, outcome.seconds, outcome.is_failure() ? printable(outcome.message) : numbers);
}

void print_failure(const TestOutcome& outcome, const fs::path& output) {
  print(fmt::format("\n{}: {}\n", outcome.test->name, printable(outcome.message)));
  if (outcome.verdict) {
    for (const std::string& note : outcome.verdict->notes) print("  " + printable(note) + "\n");
    print(fmt::format("  brightness {:+.3f} %\n", 100 * outcome.verdict->mean_change));
  }
  print("  images     " + (output / outcome.test->name).string() + "\n");
  print("  reproduce  " + printable(outcome.reproduce) + "\n");
  if (outcome.status == TestStatus::failed) print("  bless      " + printable(outcome.bless) + "\n");
}

/// The failures, the worst one first, and a last line with all counts.
void print_summary(const std::vector<TestOutcome>& outcomes, const CheckOptions& options, double seconds) {
  std::size_t failed = 0, passed = 0, before = 0;
  for (const TestOutcome* outcome : by_severity(outcomes)) {
    passed += outcome->is_passed(), failed += outcome->is_failure();
    before += outcome->status == TestStatus::passed_before;
    if (outcome->is_failure()) print_failure(*outcome, options.output);
  }
  std::string line = fmt::format("{} tests: {} passed", outcomes.size(), passed);
  if (before > 0) line += fmt::format(" ({} of them before)", before);
  line += fmt::format(", {} failed", failed);
  if (const std::size_t left = outcomes.size() - passed - failed; left > 0) line += fmt::format(", {} not run", left);
  print(fmt::format("{}{}, {:.1f} s\n", failed > 0 ? "\n" : "", line, seconds));
}

/// Names shards apart in the reports of a CI system.
std::string suite_name(const CheckOptions& options) {
  const std::string name = options.suite.stem().string();
  return options.shards > 1 ? fmt::format("{} {}/{}", name, options.shard, options.shards) : name;
}

}  // namespace

int run_check(const CheckOptions& options) {
  const Suite suite = read_suite(options.suite);
  const std::vector<const SuiteTest*> tests = select_tests(suite, options);
  make_folder(options.output);
  if (!options.html.empty()) make_folder(options.html);
  if (!options.junit.empty()) check_writable(options.junit);
  const auto start = std::chrono::steady_clock::now();
  const std::atomic<bool>& interrupted = catch_interrupts();
  ResultStore store(options.output, options.is_resumed);
  ResultStore results = store;
  const auto on_done = [&](const TestOutcome& outcome) {
    for (const std::string& warning : outcome.warnings) print_warning(outcome.test->name + ": " + warning);
    if (!options.is_quiet || outcome.is_failure()) print(outcome_line(outcome, options.is_update));
    if (outcome.status == TestStatus::passed_before) return;
    leave_failure_files(options.output, outcome);
    results.add(outcome, settings_text(*outcome.test, options));
  };
  const std::vector<TestOutcome> outcomes = run_tests(tests, options, interrupted, store, on_done);
  if (!options.junit.empty()) write_file_atomically(options.junit, junit_xml(suite_name(options), outcomes));
  if (!options.html.empty()) write_check_report(options.html, suite_name(options), outcomes);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!options.is_update || interrupted) print_summary(outcomes, options, seconds);
  if (interrupted) return exit_interrupted;
  if (options.is_update) {
    const std::size_t failed = update_goldens(outcomes, options, interrupted);
    if (interrupted) return exit_interrupted;
    return failed > 0 ? exit_difference : exit_done;
  }
  return std::ranges::any_of(outcomes, &TestOutcome::is_failure) ? exit_difference : exit_done;
}

}  // namespace candil
