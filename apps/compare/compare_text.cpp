#include <fmt/format.h>

#include <cmath>

#include "apps/compare/compare_result.h"

namespace candil {
namespace {

std::string percentage(std::size_t part, std::size_t whole) {
  if (whole == 0) return "0 %";
  return fmt::format("{:.3g} %", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

const char* kind_words(const LayerPair& layer) {
  switch (layer.kind) {
    case ValueKind::display:
      return layer.is_8_bit ? "display values of 8 bits, 0 to 1" : "display values, 0 to 1";
    case ValueKind::linear:
      return "linear colours";
    case ValueKind::data:
      return "no colours";
  }
  return "";
}

/// The mean of a map and its quantiles in one line.
std::string map_words(const LayerResult& result, Metric metric) {
  std::string words;
  for (const Measurement& measurement : result.summary) {
    if (measurement.measure.metric != metric) continue;
    const std::string name = measure_name(measurement.measure);
    const std::size_t colon = name.find(':');
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ",
                         colon == std::string::npos ? "mean" : name.substr(colon + 1), short_number(measurement.value));
  }
  return words;
}

std::string z_test_words(const LayerPair& layer, const ZTest& test) {
  const std::string p =
      test.log10_p_value > -300 ? short_number(test.p_value) : fmt::format("1e{:.0f}", test.log10_p_value);
  constexpr double clear = 1e-3;
  if (test.p_value >= clear) return fmt::format("p = {}: noise explains the differences", p);
  const ZTest::Place& worst = test.worst;
  const double relative = worst.mean_a != 0 ? worst.mean_difference / std::abs(worst.mean_a) : 0;
  return fmt::format("p = {}: most clearly {} in {}x{} pixels at {},{}, by {:+.3g}{} ({:+.1f} standard errors)", p,
                     channel_name(layer, worst.channel), worst.region.width, worst.region.height, worst.region.x,
                     worst.region.y, worst.mean_difference,
                     relative != 0 ? fmt::format(" or {:+.2g} %", 100 * relative) : "", worst.deviation);
}

std::string metric_words(const LayerPair& layer, const LayerResult& result, Metric metric, double value) {
  const Differences& differences = result.comparison.differences;
  switch (metric) {
    case Metric::exact: {
      std::string words = fmt::format("{} of {} pixels differ ({})", differences.different_pixels, differences.pixels,
                                      percentage(differences.different_pixels, differences.pixels));
      if (differences.non_finite_pixels > 0)
        words += fmt::format(", {} by values that are not finite", differences.non_finite_pixels);
      return words;
    }
    case Metric::max:
      if (differences.largest == 0) return "0";
      return fmt::format("{}{} at {},{} in {}", short_number(value),
                         layer.is_8_bit ? fmt::format(" ({:.0f}/255)", value * 255) : "", differences.largest_x,
                         differences.largest_y, channel_name(layer, differences.largest_channel));
    case Metric::psnr:
      return fmt::format("{} dB over {}", short_number(value), short_number(differences.peak));
    case Metric::bias: {
      std::string words;
      for (std::size_t c = 0; c < differences.bias.size(); ++c)
        words += fmt::format("{}{} {:+.4g}", c == 0 ? "" : ", ", channel_name(layer, static_cast<int>(c)),
                             differences.bias[c] == 0 ? 0.0 : differences.bias[c]);
      return words;
    }
    case Metric::ztest:
      return z_test_words(layer, *result.comparison.z_test);
    case Metric::error:
    case Metric::ssim:
      return map_words(result, metric);
    case Metric::flip: {
      std::string words = map_words(result, metric);
      if (const auto& exposures = result.comparison.flip->exposures)
        words += fmt::format(" (HDR, {} exposures from {:+.1f} to {:+.1f} stops)", exposures->count, exposures->start,
                             exposures->stop);
      return words;
    }
    case Metric::mse:
    case Metric::rmse:
    case Metric::relmse:
      break;
  }
  return short_number(value);
}

std::string layer_words(const LayerPair& layer, const LayerResult& result) {
  std::string text =
      fmt::format("{}: {} ({} pixels)\n", layer.name, kind_words(layer), result.comparison.differences.pixels);
  for (const MetricLine& line : describe_metrics(layer, result))
    text += fmt::format("  {:<7} {}\n", line.name, line.words);
  for (const Judgement& judgement : result.judgements)
    text += fmt::format("  {} {}\n", measure_name(judgement.threshold.measure), describe_judgement(judgement));
  return text;
}

}  // namespace

std::vector<MetricLine> describe_metrics(const LayerPair& layer, const LayerResult& result) {
  std::vector<MetricLine> lines;
  for (const Measurement& measurement : result.summary) {
    const Metric metric = measurement.measure.metric;
    if (!measurement.measure.share)
      lines.push_back({metric_name(metric), metric_words(layer, result, metric, measurement.value)});
  }
  return lines;
}

std::string describe_judgement(const Judgement& judgement) {
  return fmt::format("{} {} {}: {}", short_number(*judgement.value),
                     is_better_when_larger(judgement.threshold.measure.metric) ? ">=" : "<=",
                     short_number(judgement.threshold.limit), judgement.is_met ? "yes" : "NO");
}

std::string describe_result(const CompareOptions& options, const CompareInputs& inputs, const CompareResult& result) {
  std::string text =
      fmt::format("A {}\nB {}\n{}x{} pixels\n", options.a.string(), options.b.string(), inputs.width, inputs.height);
  for (const std::string& note : inputs.notes) text += "note: " + note + "\n";
  for (std::size_t i = 0; i < inputs.layers.size(); ++i) text += layer_words(inputs.layers[i], result.layers[i]);
  return text + verdict(result, inputs) + "\n";
}

}  // namespace candil
