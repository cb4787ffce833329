#include "apps/check/run_tests.h"

#include <fmt/format.h>

#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <thread>

#include "apps/usage_error.h"
#include "io/error.h"

namespace candil {
namespace {

RunOverrides overrides_of(const CheckOptions& options) {
  return {options.seed, options.accelerator, options.accelerator_word};
}

void note_settings(const GoldenImage& golden, const GoldenImage& render, Verdict& verdict) {
  if (golden.settings != render.settings)
    verdict.notes.push_back(fmt::format("the golden image was made with: {}", golden.settings));
}

void judge_outcome(const CheckOptions& options, TestOutcome& outcome) {
  const SuiteTest& test = *outcome.test;
  const TestRender& render = *outcome.render;
  const auto end = [&](TestStatus status, std::string message) {
    outcome.status = status, outcome.message = std::move(message);
  };
  if (render.was_interrupted) return end(TestStatus::not_run, "interrupted");
  if (render.was_out_of_time)
    return end(TestStatus::broken, fmt::format("stopped after {:.1f} s, its time limit is {:g} s", render.seconds,
                                               test.time_limit_seconds));
  if (render.non_finite_samples > 0)
    return end(TestStatus::broken, fmt::format("{} samples were not finite", render.non_finite_samples));
  if (!std::filesystem::exists(test.golden)) {
    const char* const advice = options.is_update ? "" : "; look at the picture, then make it by: ";
    return end(TestStatus::failed, fmt::format("no golden image {}{}{}", test.golden.string(), advice,
                                               options.is_update ? "" : outcome.bless));
  }
  outcome.golden = read_golden(test.golden);
  Verdict verdict = judge_render(*outcome.golden, render.image, test.thresholds, render.display);
  note_settings(*outcome.golden, render.image, verdict);
  if (verdict.is_passed()) {
    outcome.status = TestStatus::passed;
  } else {
    end(TestStatus::failed, verdict.failure.empty() ? describe_findings(verdict, true) : verdict.failure);
  }
  outcome.verdict = std::move(verdict);
}

TestOutcome run_test(const SuiteTest& test, const CheckOptions& options, const std::atomic<bool>& interrupted,
                     const ResultStore& store) {
  const RunOverrides overrides = overrides_of(options);
  TestOutcome outcome;
  outcome.test = &test;
  outcome.reproduce = render_command_line(test, overrides);
  outcome.bless = shell_words({"candil", "check", options.suite.string(), "--update", test.name});
  if (options.is_resumed && store.has_passed(test, settings_text(test, options))) {
    outcome.status = TestStatus::passed_before;
    return outcome;
  }
  try {
    outcome.render = render_test(test, overrides, options.threads, interrupted);
    outcome.seconds = outcome.render->seconds;
    outcome.warnings = outcome.render->warnings;
    judge_outcome(options, outcome);
  } catch (const std::bad_alloc&) {
    outcome.status = TestStatus::broken, outcome.message = "not enough memory";
  } catch (const std::exception& error) {
    outcome.status = TestStatus::broken, outcome.message = error.what();
  }
  return outcome;
}

}  // namespace

std::string settings_text(const SuiteTest& test, const CheckOptions& options) {
  const CheckThresholds& limits = test.thresholds;
  std::string text = render_command_line(test, overrides_of(options));
  text += fmt::format("\nztest {} signs {} flip {}", limits.z_test, limits.sign_test, limits.flip.value_or(-1));
  for (const Threshold& threshold : limits.others)
    text += fmt::format(" {} {}", measure_name(threshold.measure), threshold.limit);
  return text;
}

std::vector<TestOutcome> run_tests(const std::vector<const SuiteTest*>& tests, const CheckOptions& options,
                                   const std::atomic<bool>& interrupted, const ResultStore& store,
                                   const std::function<void(const TestOutcome&)>& on_done) {
  std::vector<TestOutcome> outcomes(tests.size());
  for (std::size_t i = 0; i < tests.size(); ++i) outcomes[i].test = tests[i], outcomes[i].message = "interrupted";
  std::atomic<std::size_t> next{0};
  std::mutex done_mutex;
  std::exception_ptr first_error;
  const auto work = [&] {
    for (std::size_t i = next++; i < tests.size() && !interrupted; i = next++) {
      TestOutcome outcome = run_test(*tests[i], options, interrupted, store);
      const std::scoped_lock lock(done_mutex);
      outcomes[i] = std::move(outcome);
      try {
        if (!first_error && outcomes[i].status != TestStatus::not_run) on_done(outcomes[i]);
      } catch (...) {
        first_error = std::current_exception();
        next = tests.size();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(tests.size(), static_cast<std::size_t>(options.jobs)); ++i)
      helpers.emplace_back(work);
    work();
  }
  if (first_error) std::rethrow_exception(first_error);
  return outcomes;
}

}  // namespace candil
