#include "apps/compare/compare_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <limits>

#include "apps/option_values.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

constexpr const char* footer = R"(
Metrics, of A (the reference) and B, with d = b - a:
  exact     pixels with any difference       psnr    decibels; of linear images, over the largest value of A
  max       largest |d|                      ssim    structural similarity of the luma, 1: equal (map)
  error     |d|, largest of the channels (map)       flip    what a person sees, 0 to 1 (map)
  mse rmse  mean d^2, its root               bias    mean d of the channel where it is largest
  relmse    mean d^2 / (a^2 + 0.01)          ztest   chance that noise explains d (renders with --variance)
PNG, JPEG and other files of integers are compared as stored (sRGB in [0, 1]); as soon as one of the two is linear, both
are. FLIP of linear images is that for high dynamic range.

A threshold is the largest value that is put up with; for psnr, ssim and ztest the smallest. Metrics with a map take
:pNN (percentile), :median, :min and :max; without, their mean counts. Without a threshold any difference counts.

Examples:
  candil compare golden.png test.png                             exit code 1 if any pixel differs
  candil compare golden.png test.png --threshold flip=0.02 --threshold flip:p99=0.2
  candil compare golden.exr test.exr --threshold ztest=1e-6      other noise is the same, a change is not
  candil compare golden.exr test.exr --layer all --json | jq .layers[].metrics
  candil compare a.exr b.exr --html report.html --diff heat.png  to look at, in any browser
  candil compare a.png b.png --region 0,0,100x50 --mask mask.png

Exit codes: 0 same, 1 different, 2 wrong usage, 3 an image cannot be used, 4 an output cannot be written.)";

/// 0 to 1 for the words after the colon.
double parse_share(std::string_view option, std::string_view text, std::string_view word) {
  if (word == "min") return 0;
  if (word == "median") return 0.5;
  if (word == "max") return 1;
  if (!word.starts_with('p'))
    throw UsageError(
        fmt::format("{}: '{}': '{}' is not a percentile like p99, nor min, median or max", option, text, word));
  return parse_real(option, word.substr(1), 0, 100) / 100;
}

Region parse_region(std::string_view option, std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 3) throw UsageError(fmt::format("{}: '{}' is not a region like 10,20,300x200", option, text));
  const ImageSize size = parse_size(option, parts[2]);
  return {static_cast<int>(parse_integer(option, parts[0], 0, max_image_side)),
          static_cast<int>(parse_integer(option, parts[1], 0, max_image_side)), size.width, size.height};
}

std::vector<std::string> metric_words() {
  std::vector<std::string> words;
  for (const Metric metric : all_metrics()) words.push_back(metric_name(metric));
  return words;
}

}  // namespace

Threshold parse_threshold(std::string_view option, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos)
    throw UsageError(fmt::format("{}: '{}' is not METRIC=VALUE, like flip:p99=0.1", option, text));
  const std::string_view name = text.substr(0, equals), word = name.substr(0, name.find(':'));
  const std::optional<Metric> metric = metric_from_name(word);
  if (!metric) fail_choice(option, word, metric_words());
  Threshold threshold;
  threshold.measure.metric = *metric;
  if (word.size() < name.size()) {
    const std::string_view statistic = name.substr(word.size() + 1);
    if (!has_map(*metric) && statistic != "mean")
      throw UsageError(fmt::format("{}: '{}': {} has no map; error, ssim and flip have", option, text, word));
    if (statistic != "mean") threshold.measure.share = parse_share(option, text, statistic);
  }
  constexpr double largest = std::numeric_limits<double>::max();
  threshold.limit = parse_real(option, text.substr(equals + 1), -largest, largest);
  return threshold;
}

void add_compare_arguments(CLI::App& app, CompareOptions& options) {
  const auto add = [&app](const std::string& name, const std::string& value, const std::string& help, const auto& set) {
    const auto call = [name, set](const std::vector<std::string>& words) {
      for (const std::string& word : words) set(name, word);
    };
    return app.add_option_function<std::vector<std::string>>(name, call, help)
        ->type_name(value)
        ->allow_extra_args(false);
  };
  const auto last = CLI::MultiOptionPolicy::TakeLast;
  const std::string kinds = ".exr .hdr .pfm .ppm .tif .png .jpg .webp";
  app.add_option_function<std::string>(
         "A", [&](const std::string& text) { options.a = text; }, "The reference image: " + kinds)
      ->required();
  app.add_option_function<std::string>(
         "B", [&](const std::string& text) { options.b = text; }, "The image to test")
      ->required();
  add("--threshold,-t", "METRIC[:pNN]=VALUE", "What is put up with; may be given several times (default: exact=0)",
      [&](const auto&, const auto& text) { options.thresholds.push_back(parse_threshold("--threshold", text)); })
      ->group("Judgement");
  add("--layer", "NAME",
      "A layer of EXR files; may be given several times. `picture` is the one without a name, `all` "
      "are those that both have (default: the picture)",
      [&](const auto&, const auto& text) { options.layers.push_back(text); })
      ->group("Judgement");
  add("--region", "X,Y,WxH", "Count these pixels only, from the upper left corner; several are put together",
      [&](const auto& option, const auto& text) { options.regions.push_back(parse_region(option, text)); })
      ->group("Judgement");
  add("--mask", "FILE", "Count only the pixels that are white (at least half) in this image of the same size",
      [&](const auto&, const auto& text) { options.mask = text; })
      ->group("Judgement")
      ->multi_option_policy(last);
  add("--align", "HOW", "Images of different sizes: none (default) refuses them, resize makes B as large as A",
      [&](const auto& option, const auto& text) {
        if (text != "none" && text != "resize") fail_choice(option, text, {"none", "resize"});
        options.resizes = text == "resize";
      })
      ->group("Judgement")
      ->multi_option_policy(last);
  add("--ppd", "PIXELS",
      "FLIP: pixels per degree of the observer's view (default 67: 0.7 m from a 0.7 m wide 4K screen)",
      [&](const auto& option, const auto& text) {
        options.settings.flip.pixels_per_degree = parse_real(option, text, 1, 1000);
      })
      ->group("Judgement")
      ->multi_option_policy(last);
  add("--diff", "FILE",
      "Write where they differ: heat map of FLIP (of layers without colours, of the error) as .png, "
      ".jpg ...; its values as .exr or .pfm",
      [&](const auto&, const auto& text) { options.diff = text; })
      ->group("Output")
      ->multi_option_policy(last);
  add("--html", "FILE", "Write a report to look at in a browser: one file that needs nothing else",
      [&](const auto&, const auto& text) { options.html = text; })
      ->group("Output")
      ->multi_option_policy(last);
  app.add_flag("--json{-}", options.json, "Print JSON for machines; --json=FILE writes it to a file")->group("Output");
  app.add_flag("--quiet,-q", options.is_quiet, "Print no numbers; errors stay")->group("Output");
  app.footer(footer);
}

}  // namespace candil
