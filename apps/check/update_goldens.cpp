#include "apps/check/update_goldens.h"

#include <fmt/format.h>

#include <cstdio>

#include "apps/messages.h"

namespace candil {
namespace {

bool has_picture(const TestOutcome& outcome) {
  return outcome.render && !outcome.render->image.mean.empty() && outcome.render->non_finite_samples == 0;
}

/// Why the golden image has to be written; empty: it stays.
std::string reason(const TestOutcome& outcome) {
  const GoldenImage& render = outcome.render->image;
  if (!outcome.golden) return std::filesystem::exists(outcome.test->golden) ? "cannot be used" : "is new";
  if (!outcome.is_passed()) {
    const std::string what = fmt::format("changes: {}", outcome.message);
    return outcome.verdict && outcome.verdict->failure.empty()
               ? fmt::format("{}, {:+.2f} % in brightness", what, 100 * outcome.verdict->mean_change)
               : what;
  }
  if (outcome.golden->settings != render.settings) return "looks the same, but its options have changed";
  if (outcome.golden->scene_hash != render.scene_hash) return "looks the same, but the scene's files have changed";
  if (!outcome.golden->flip_noise) return "looks the same, but does not know its noise";
  return "";
}

void write(const TestOutcome& outcome, const CheckOptions& options, const std::atomic<bool>& interrupted) {
  GoldenImage golden = outcome.render->image;
  const TestRender sibling = render_sibling(*outcome.test, options.jobs * options.threads, interrupted);
  if (!sibling.image.mean.empty()) golden.flip_noise = mean_flip(golden, sibling.image);
  if (const auto& request = outcome.render->display)
    golden.display = to_display(golden.mean, request->exposure, request->tonemap);
  round_golden(golden);
  if (interrupted) return;
  write_golden(outcome.test->golden, golden);
}

}  // namespace

std::size_t update_goldens(const std::vector<TestOutcome>& outcomes, const CheckOptions& options,
                           const std::atomic<bool>& interrupted) {
  std::vector<const TestOutcome*> changed;
  std::size_t failed = 0, kept = 0;
  for (const TestOutcome& outcome : outcomes) {
    if (!has_picture(outcome)) {
      std::printf("%s: not updated: %s\n", outcome.test->name.c_str(), printable(outcome.message).c_str());
      ++failed;
      continue;
    }
    if (!outcome.test->makes_golden) {
      // Another test makes the image; this one only looks at it.
      if (!outcome.is_passed() && outcome.golden) {
        std::printf("%s: %s, but its golden image is made by another test\n", outcome.test->name.c_str(),
                    printable(outcome.message).c_str());
      }
      continue;
    }
    const std::string why = reason(outcome);
    if (why.empty()) {
      ++kept;
      continue;
    }
    std::printf("%s: %s %s\n", outcome.test->name.c_str(), outcome.test->golden.string().c_str(),
                printable(why).c_str());
    changed.push_back(&outcome);
  }
  std::fflush(stdout);
  for (const TestOutcome* outcome : changed)
    if (!interrupted) write(*outcome, options, interrupted);
  std::printf("%zu golden images written, %zu kept as they are, %zu tests not updated\n", changed.size(), kept, failed);
  return failed;
}

}  // namespace candil
