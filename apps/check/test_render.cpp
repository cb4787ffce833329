#include "apps/check/test_render.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

#include "apps/render_arguments.h"
#include "apps/render_steps.h"

namespace candil {
namespace {

using Clock = std::chrono::steady_clock;

RenderOptions options_of(const SuiteTest& test, const RunOverrides& overrides, int threads) {
  std::vector<std::string> words = test.words;
  words.push_back(test.scene.string());
  RenderOptions options = parse_render_words(words);
  options.environment.image = test.environment;
  options.settings.threads = threads;
  if (overrides.seed) {
    options.settings.seed = *overrides.seed;
    options.given.insert("--seed");
  }
  if (overrides.accelerator) options.accelerator = *overrides.accelerator;
  return options;
}

Image without_alpha(const Image& image) {
  Image rgb(image.width, image.height, 3);
  for (std::size_t i = 0; i < rgb.pixels.size() / 3; ++i)
    std::copy_n(&image.pixels[i * image.channels], 3, &rgb.pixels[i * 3]);
  return rgb;
}

/// Where the test or its scene says how its picture is to be shown, that is tested too.
std::optional<DisplayRequest> display_request(const RenderOptions& options, const RenderDefaults& of_file) {
  const bool is_asked = options.given.contains("--tonemap") || options.given.contains("--exposure") ||
                        of_file.tonemap || of_file.exposure;
  if (!is_asked) return std::nullopt;
  return DisplayRequest{*options.display.tonemap, options.display.exposure};
}

GoldenImage golden_of(const SuiteTest& test, const RenderPlan& plan, const Film& film) {
  GoldenImage image;
  image.mean = plan.options.display.is_transparent ? film.mean() : without_alpha(film.mean());
  image.variance = film.variance();
  image.samples = film.sample_count();
  image.settings = shell_words(test.words);
  for (const auto& [key, value] : describe_render(plan, image.samples))
    if (key != "candil:spp") image.origin.emplace_back(key, value);
  round_golden(image);
  return image;
}

TestRender render_with(const SuiteTest& test, const RenderOptions& options, const std::atomic<bool>& interrupted) {
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  TestRender render;
  tbb::task_arena arena(options.settings.threads);
  const std::unique_ptr<PreparedScene> prepared = arena.execute([&] { return prepare_scene(options); });
  render.files = prepared->files;
  render.warnings = prepared->warnings;
  const RenderPlan plan = plan_render(*prepared, options);
  std::atomic<bool> stop{false};
  const auto look_at_clock = [&](const RenderProgress&) {
    if (interrupted || seconds() > test.time_limit_seconds) stop = true;
  };
  const RenderResult result = render_scene(*prepared, plan, look_at_clock, &stop);
  render.seconds = seconds();
  render.was_interrupted = interrupted;
  render.was_out_of_time =
      !render.was_interrupted && (result.was_interrupted || render.seconds > test.time_limit_seconds);
  if (render.was_interrupted || render.was_out_of_time) return render;
  render.non_finite_samples = result.non_finite_samples;
  render.image = golden_of(test, plan, result.film);
  render.image.scene_hash = hash_files(render.files);
  render.display = display_request(plan.options, prepared->defaults);
  return render;
}

}  // namespace

TestRender render_test(const SuiteTest& test, const RunOverrides& overrides, int threads,
                       const std::atomic<bool>& interrupted) {
  return render_with(test, options_of(test, overrides, threads), interrupted);
}

TestRender render_sibling(const SuiteTest& test, int threads, const std::atomic<bool>& interrupted) {
  RunOverrides overrides;
  overrides.seed = options_of(test, {}, threads).settings.seed + 1;
  return render_with(test, options_of(test, overrides, threads), interrupted);
}

std::string shell_word(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./:,=+@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string shell_words(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

std::string render_command_line(const SuiteTest& test, const RunOverrides& overrides) {
  std::vector<std::string> words = {"candil", "render", test.scene.string()};
  words.insert(words.end(), test.words.begin(), test.words.end());
  if (!test.environment.empty()) words.insert(words.end(), {"--env", test.environment});
  if (overrides.seed) words.insert(words.end(), {"--seed", std::to_string(*overrides.seed)});
  if (overrides.accelerator) words.insert(words.end(), {"--accel", overrides.accelerator_word});
  words.insert(words.end(), {"-o", test.name + ".exr"});
  return shell_words(words);
}

}  // namespace candil
