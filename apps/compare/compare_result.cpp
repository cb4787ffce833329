#include "apps/compare/compare_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/error.h"

namespace candil {
namespace {

std::optional<PairVariance> variance_of(const CompareInputs& inputs, const LayerPair& layer) {
  if (!inputs.variance_a || layer.name != "picture") return std::nullopt;
  const FileVariance &a = *inputs.variance_a, &b = *inputs.variance_b;
  return PairVariance{{a.image, a.samples}, {b.image, b.samples}};
}

}  // namespace

bool LayerResult::is_same() const { return std::ranges::all_of(judgements, &Judgement::is_met); }
bool CompareResult::is_same() const { return std::ranges::all_of(layers, &LayerResult::is_same); }

CompareResult compare_layers(const CompareOptions& options, const CompareInputs& inputs,
                             const PixelSelection& selection) {
  CompareResult result;
  result.has_thresholds = !options.thresholds.empty();
  CompareSettings settings = options.settings;
  settings.z_test.rounding = inputs.rounding;
  std::vector<Threshold> thresholds = options.thresholds;
  if (thresholds.empty()) thresholds.push_back({{Metric::exact}, 0});
  std::vector<bool> is_used(thresholds.size(), false);
  for (const LayerPair& layer : inputs.layers) {
    const std::optional<PairVariance> variance = variance_of(inputs, layer);
    LayerResult found{compare_images(layer.pair(), selection, settings, variance), {}, {}};
    found.summary = summarize(found.comparison);
    const std::vector<Judgement> judgements = judge(found.comparison, thresholds);
    for (std::size_t i = 0; i < judgements.size(); ++i) {
      if (!judgements[i].value) continue;
      is_used[i] = true;
      found.judgements.push_back(judgements[i]);
    }
    result.layers.push_back(std::move(found));
  }
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    if (is_used[i]) continue;
    const bool is_ztest = thresholds[i].measure.metric == Metric::ztest;
    throw InputError(options.b.string(), "",
                     fmt::format("cannot be judged by {}: {}", measure_name(thresholds[i].measure),
                                 is_ztest ? "it takes two linear images with their variance (candil render --variance)"
                                          : "no layer that is compared has colours"));
  }
  return result;
}

std::string short_number(double value) { return fmt::format("{:.6g}", value == 0 ? 0.0 : value); }

std::string channel_name(const LayerPair& layer, int channel) {
  const auto place = static_cast<std::size_t>(channel);
  return place < layer.channels.size() && !layer.channels[place].empty() ? layer.channels[place]
                                                                         : std::to_string(channel);
}

std::string verdict(const CompareResult& result, const CompareInputs& inputs) {
  if (result.is_same()) {
    if (result.has_thresholds) return "same: within all thresholds";
    return "same: no value differs";
  }
  if (!result.has_thresholds) return "different: without a --threshold any difference counts";
  std::string text = "different:";
  for (std::size_t i = 0; i < result.layers.size(); ++i)
    for (const Judgement& judgement : result.layers[i].judgements) {
      if (judgement.is_met) continue;
      const Measure& measure = judgement.threshold.measure;
      text += fmt::format("{} {}{} is {}, {} than {}", text.back() == ':' ? "" : ",",
                          inputs.layers.size() > 1 ? inputs.layers[i].name + " " : "", measure_name(measure),
                          short_number(*judgement.value), is_better_when_larger(measure.metric) ? "less" : "more",
                          short_number(judgement.threshold.limit));
    }
  return text;
}

}  // namespace candil
