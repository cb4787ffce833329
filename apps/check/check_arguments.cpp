#include "apps/check/check_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "apps/accelerator_argument.h"
#include "apps/arguments.h"
#include "apps/option_values.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

constexpr const char* footer = R"(
A test passes when its render and its golden image differ by no more than noise: by the z-test of their variances, by
the signs of their differences, and by what a person sees (FLIP). docs/ci.md tells how suites are written.

Examples:
  candil check suite.toml                                 render all, compare all, the worst first
  candil check suite.toml --filter glass --filter 'fig1*' tests of that tag, and tests of such names
  candil check suite.toml --junit out.xml --html report   for CI: results, and pages to look at
  candil check suite.toml --shard 2/8                     the second of eight machines
  candil check suite.toml --resume                        only what has not passed yet
  candil check suite.toml --update cornell                make this golden image anew
  candil check suite.toml --update                        all of them; shows what changes, keeps those that pass

Exit codes: 0 all tests passed, 1 a test failed, 2 wrong usage, 3 the suite cannot be used, 4 a result cannot be
written, 130 interrupted.)";

void parse_shard(const std::string& text, CheckOptions& options) {
  const std::vector<std::string_view> parts = split(text, '/');
  if (parts.size() != 2) throw UsageError("--shard: '" + text + "' is not like 2/8");
  options.shards = static_cast<int>(parse_integer("--shard", parts[1], 1, 10000));
  options.shard = static_cast<int>(parse_integer("--shard", parts[0], 1, static_cast<std::uint64_t>(options.shards)));
}

void add_selection(CLI::App& app, Arguments& arguments, CheckOptions& options) {
  arguments.group("Tests");
  app.add_option("--filter", options.filters, "Only tests of this name (* stands for any text) or tag; may be repeated")
      ->type_name("NAME|TAG")
      ->allow_extra_args(false)
      ->group("Tests");
  arguments.add("--shard", "I/N", "Only the I-th of N parts of the tests",
                [&](const auto&, const auto& text) { parse_shard(text, options); });
  arguments.add_flag("--resume", "Skip tests that have passed in the output folder, as long as nothing has changed",
                     options.is_resumed);
}

void add_rendering(Arguments& arguments, CheckOptions& options) {
  arguments.group("Rendering");
  arguments.add("--jobs", "N", "Tests at a time (default: one for each processor)",
                [&](const auto& option, const auto& text) {
                  options.jobs = static_cast<int>(parse_integer(option, text, 1, 1024));
                });
  arguments.add("--threads", "N", "Threads of each test (default: what --jobs leaves)",
                [&](const auto& option, const auto& text) {
                  options.threads = static_cast<int>(parse_integer(option, text, 1, 1024));
                });
  arguments.add(
      "--seed", "N", "This seed instead of those of the tests: they must pass with any",
      [&](const auto& option, const auto& text) { options.seed = parse_integer(option, text, 0, ~std::uint64_t{0}); });
  arguments.add("--accel", "NAME", "This accelerator for all tests, as for `candil render`",
                [&](const auto& option, const auto& text) {
                  options.accelerator = parse_accelerator(option, text);
                  options.accelerator_word = text;
                });
}

void add_results(CLI::App& app, Arguments& arguments, CheckOptions& options) {
  arguments.group("Results");
  const auto path = [&](const char* name, const char* value, const char* help, std::filesystem::path& target) {
    arguments.add(name, value, help, [&target](const auto&, const auto& text) { target = text; });
  };
  path("--output", "DIR", "Results, and of failed tests the images (default: candil-check)", options.output);
  path("--junit", "FILE", "Write results as JUnit XML", options.junit);
  path("--html", "DIR", "Write pages that show the tests, index.html first", options.html);
  app.add_option("--update", options.updates,
                 "Write golden images anew, of all tests or of those named; passed tests keep theirs")
      ->type_name("[NAME...]")
      ->expected(0, -1)
      ->group("Results");
  arguments.add_flag("--quiet,-q", "Only failed tests and the last line", options.is_quiet);
}

}  // namespace

void add_check_arguments(CLI::App& app, CheckOptions& options) {
  Arguments arguments(app);
  app.add_option_function<std::string>(
      "SUITE", [&](const std::string& text) { options.suite = text; }, "Suite file, .toml");
  add_selection(app, arguments, options);
  add_rendering(arguments, options);
  add_results(app, arguments, options);
  app.footer(footer);
}

void complete_check_arguments(CheckOptions& options) {
  // `--update suite.toml`: the suite went where names go.
  const auto looks_like_suite = [](const std::string& word) { return word.ends_with(".toml"); };
  const auto found = std::ranges::find_if(options.updates, looks_like_suite);
  if (options.suite.empty() && found != options.updates.end()) {
    options.suite = *found;
    options.updates.erase(found);
  }
  if (options.suite.empty()) throw UsageError("check: no suite given; try `candil check suite.toml`");
  std::erase(options.updates, "");
  if (options.is_update && (options.seed || options.accelerator))
    throw UsageError("--update: golden images are made as the suite says, without --seed and --accel");
  if (options.is_update && options.is_resumed) throw UsageError("--update: not with --resume, which leaves tests out");
  const int processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (options.jobs == 0) options.jobs = options.threads > 0 ? std::max(1, processors / options.threads) : processors;
  if (options.threads == 0) options.threads = std::max(1, processors / options.jobs);
}

}  // namespace candil
