/// All metrics of two images.
#pragma once

#include <optional>
#include <vector>

#include "metrics/differences.h"
#include "metrics/flip.h"
#include "metrics/metric.h"
#include "metrics/z_test.h"

namespace candil {

struct CompareSettings {
  FlipSettings flip;
  ZTestSettings z_test;
  bool with_ssim = true, with_flip = true;  ///< For colour; data has neither.
};

/// The noise of both images, where it is known.
struct PairVariance {
  ImageVariance a, b;
};

struct Comparison {
  ValueKind kind = ValueKind::linear;
  PixelSelection selection, ssim_pixels;
  Differences differences;
  std::optional<Image> ssim;
  std::optional<Flip> flip;
  std::optional<ZTest> z_test;  ///< Of linear colour with variances.
};

Comparison compare_images(const ImagePair& pair, const PixelSelection& selection, const CompareSettings& settings = {},
                          const std::optional<PairVariance>& variance = {});

/// A metric, or a quantile of its map: the share of the pixels that do not exceed it, 0 to 1.
struct Measure {
  Metric metric = Metric::exact;
  std::optional<double> share = {};

  bool operator==(const Measure&) const = default;
};

/// "flip", "flip:p99" (also p99.9), "flip:max" and "flip:min" for shares 1 and 0, "flip:median".
std::string measure_name(const Measure& measure);

struct Measurement {
  Measure measure;
  double value = 0;
};

/// The values, in the same order; nothing where the comparison does not have the metric.
std::vector<std::optional<double>> measure(const Comparison& comparison, const std::vector<Measure>& measures);

/// What a comparison has to say: every metric that it has, and of the maps some quantiles.
std::vector<Measurement> summarize(const Comparison& comparison);

/// The most that is put up with; of metrics that are better when larger, the least.
struct Threshold {
  Measure measure;
  double limit = 0;
};

struct Judgement {
  Threshold threshold;
  std::optional<double> value;  ///< Nothing: the images have no such metric.
  bool is_met = false;          ///< Never without a value, nor with one that is not a number.
};

std::vector<Judgement> judge(const Comparison& comparison, const std::vector<Threshold>& thresholds);

}  // namespace candil
