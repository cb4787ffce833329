#include "metrics/comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "metrics/map_statistics.h"
#include "metrics/ssim.h"

namespace candil {
namespace {

struct MapOfMetric {
  const Image* map;
  const PixelSelection* pixels;
};

std::optional<MapOfMetric> map_of(const Comparison& comparison, Metric metric) {
  if (metric == Metric::error) return MapOfMetric{&comparison.differences.error, &comparison.selection};
  if (metric == Metric::ssim && comparison.ssim) return MapOfMetric{&*comparison.ssim, &comparison.ssim_pixels};
  if (metric == Metric::flip && comparison.flip) return MapOfMetric{&comparison.flip->map, &comparison.selection};
  return std::nullopt;
}

std::optional<double> whole_value(const Comparison& comparison, Metric metric) {
  const Differences& differences = comparison.differences;
  switch (metric) {
    case Metric::exact:
      return static_cast<double>(differences.different_pixels);
    case Metric::max:
      return differences.largest;
    case Metric::mse:
      return differences.mean_squared;
    case Metric::rmse:
      return differences.root_mean_squared();
    case Metric::relmse:
      return differences.relative_mean_squared;
    case Metric::psnr:
      return differences.peak_signal_to_noise();
    case Metric::bias:
      return differences.largest_bias();
    case Metric::ztest:
      return comparison.z_test ? std::optional(comparison.z_test->p_value) : std::nullopt;
    case Metric::error:
    case Metric::ssim:
    case Metric::flip:
      break;  // means of maps
  }
  const std::optional<MapOfMetric> map = map_of(comparison, metric);
  return map ? std::optional(map_mean(*map->map, *map->pixels)) : std::nullopt;
}

bool is_within(Metric metric, double value, double limit) {
  if (is_better_when_larger(metric)) return value >= limit;
  return (metric == Metric::bias ? std::abs(value) : value) <= limit;
}

}  // namespace

Comparison compare_images(const ImagePair& pair, const PixelSelection& selection, const CompareSettings& settings,
                          const std::optional<PairVariance>& variance) {
  Comparison comparison{pair.kind, selection, selection, measure_differences(pair, selection), {}, {}, {}};
  if (!pair.is_color()) return comparison;
  if (settings.with_ssim) {
    comparison.ssim = measure_ssim(pair);
    comparison.ssim_pixels = ssim_selection(selection);
  }
  if (settings.with_flip) comparison.flip = measure_flip(pair, settings.flip);
  if (variance && pair.kind == ValueKind::linear)
    comparison.z_test = measure_z_test(pair, variance->a, variance->b, selection, settings.z_test);
  return comparison;
}

std::string measure_name(const Measure& measure) {
  const std::string name = metric_name(measure.metric);
  if (!measure.share) return name;
  if (*measure.share == 0) return name + ":min";
  if (*measure.share == 0.5) return name + ":median";
  if (*measure.share == 1) return name + ":max";
  std::array<char, 32> percent;
  std::snprintf(percent.data(), percent.size(), ":p%.6g", *measure.share * 100);
  return name + percent.data();
}

std::vector<std::optional<double>> measure(const Comparison& comparison, const std::vector<Measure>& measures) {
  std::vector<std::optional<double>> values(measures.size());
  for (const Metric metric : all_metrics()) {
    // All quantiles of a map in one go.
    std::vector<double> shares;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < measures.size(); ++i) {
      if (measures[i].metric != metric) continue;
      if (measures[i].share)
        shares.push_back(*measures[i].share), places.push_back(i);
      else
        values[i] = whole_value(comparison, metric);
    }
    const std::optional<MapOfMetric> map = map_of(comparison, metric);
    if (!map || shares.empty()) continue;
    const std::vector<float> quantiles = map_quantiles(*map->map, *map->pixels, shares);
    for (std::size_t k = 0; k < places.size(); ++k) values[places[k]] = quantiles[k];
  }
  return values;
}

std::vector<Measurement> summarize(const Comparison& comparison) {
  std::vector<Measure> measures;
  for (const Metric metric : all_metrics()) {
    measures.push_back({metric});
    if (!has_map(metric)) continue;
    constexpr std::array high = {0.5, 0.95, 0.99, 1.0}, low = {0.0, 0.01, 0.05, 0.5};
    for (const double share : is_better_when_larger(metric) ? low : high) measures.push_back({metric, share});
  }
  const std::vector<std::optional<double>> values = measure(comparison, measures);
  std::vector<Measurement> summary;
  for (std::size_t i = 0; i < measures.size(); ++i)
    if (values[i]) summary.push_back({measures[i], *values[i]});
  return summary;
}

std::vector<Judgement> judge(const Comparison& comparison, const std::vector<Threshold>& thresholds) {
  std::vector<Measure> measures;
  for (const Threshold& threshold : thresholds) measures.push_back(threshold.measure);
  const std::vector<std::optional<double>> values = measure(comparison, measures);
  std::vector<Judgement> judgements;
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    const bool is_met = values[i] && is_within(measures[i].metric, *values[i], thresholds[i].limit);
    judgements.push_back({thresholds[i], values[i], is_met});
  }
  return judgements;
}

}  // namespace candil
