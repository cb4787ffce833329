/// One render of a suite.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/check/golden_file.h"
#include "apps/check/judge.h"
#include "apps/check/suite.h"
#include "core/accelerator.h"

namespace candil {

/// What the command line of `candil check` sets for all tests.
struct RunOverrides {
  std::optional<std::uint64_t> seed;
  std::optional<AcceleratorOptions> accelerator;
  std::string accelerator_word;  ///< As typed.
};

struct TestRender {
  GoldenImage image;  ///< Rounded.
  std::optional<DisplayRequest> display;
  std::vector<std::filesystem::path> files;  ///< That the scene is made of.
  std::vector<std::string> warnings;
  std::uint64_t non_finite_samples = 0;
  double seconds = 0;  ///< Loading and rendering.
  bool was_out_of_time = false, was_interrupted = false;
};

/// Renders with `threads` threads. Stops soon after the test's time limit, or when `interrupted` becomes true: then
/// there is no picture. Throws InputError and UsageError.
TestRender render_test(const SuiteTest& test, const RunOverrides& overrides, int threads,
                       const std::atomic<bool>& interrupted);

/// The same with the next seed.
TestRender render_sibling(const SuiteTest& test, int threads, const std::atomic<bool>& interrupted);

/// The words of the command line that renders the same picture: "candil render scene.json --spp 16 ... -o name.exr".
std::string render_command_line(const SuiteTest& test, const RunOverrides& overrides);

/// One word for a shell, in quotes where it needs them.
std::string shell_word(const std::string& word);
std::string shell_words(const std::vector<std::string>& words);

}  // namespace candil
