#include "apps/aov_arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/option_values.h"

namespace candil {
namespace {

constexpr const char* all = "all";

std::vector<std::string> allowed_words() {
  std::vector<std::string> words;
  for (const Aov aov : all_aovs()) words.push_back(aov_name(aov));
  words.emplace_back(all);
  return words;
}

/// Each once, in the order of the enumeration.
std::vector<Aov> parse_aovs(const std::string& text) {
  std::vector<Aov> asked;
  for (const std::string_view word : split(text, ',')) {
    if (word == all) {
      asked.insert(asked.end(), all_aovs().begin(), all_aovs().end());
      continue;
    }
    const std::optional<Aov> aov = aov_from_name(word);
    if (!aov) fail_choice("--aov", word, allowed_words());
    asked.push_back(*aov);
  }
  std::ranges::sort(asked);
  const auto repeated = std::ranges::unique(asked);
  asked.erase(repeated.begin(), repeated.end());
  return asked;
}

}  // namespace

void add_aov_arguments(CLI::App& app, AovOptions& options) {
  app.add_option_function<std::string>(
         "--aov", [&options](const std::string& text) { options.list = parse_aovs(text); },
         fmt::format(
             "Also write, with commas between them: {}. Layers of .exr outputs; without one, files beside the first "
             "output: picture.depth.exr",
             fmt::join(allowed_words(), ", ")))
      ->type_name("LIST")
      ->group("Output")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_flag("--variance", options.with_variance,
               "Also write the variance of the pixels, like an AOV: `candil compare` tells noise from changes by it")
      ->group("Output");
  app.add_flag("--aov-separate", options.is_separate,
               "Files of their own for --aov and --variance, also beside an .exr output")
      ->group("Output");
}

}  // namespace candil
