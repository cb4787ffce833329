/// What `candil compare` has found, and how it is told.
#pragma once

#include <string>
#include <vector>

#include "apps/compare/compare_inputs.h"

namespace candil {

struct LayerResult {
  Comparison comparison;
  std::vector<Measurement> summary;
  std::vector<Judgement> judgements;  ///< Of the thresholds that suit the layer.

  bool is_same() const;
};

struct CompareResult {
  std::vector<LayerResult> layers;  ///< In the order of CompareInputs::layers.
  bool has_thresholds = false;      ///< Else any difference counts.

  bool is_same() const;
};

/// Compares and judges every layer. Thresholds on metrics that a layer does not have are left out there; throws
/// InputError for one that no layer has.
CompareResult compare_layers(const CompareOptions& options, const CompareInputs& inputs,
                             const PixelSelection& selection);

/// One metric of a layer in words.
struct MetricLine {
  std::string name, words;
};
std::vector<MetricLine> describe_metrics(const LayerPair& layer, const LayerResult& result);

/// "0.12 <= 0.1: NO".
std::string describe_judgement(const Judgement& judgement);

/// For people: lines that end in '\n'.
std::string describe_result(const CompareOptions& options, const CompareInputs& inputs, const CompareResult& result);

/// For machines. Numbers that are not finite are null.
std::string result_json(const CompareOptions& options, const CompareInputs& inputs, const CompareResult& result);

/// "same", or what is different: "different: flip:p99 is 0.12, more than 0.1".
std::string verdict(const CompareResult& result, const CompareInputs& inputs);

/// Six digits at the most: "0.0123", "12", "1.2e-07".
std::string short_number(double value);

/// "R", "X", "id", or of a channel without a name its number.
std::string channel_name(const LayerPair& layer, int channel);

}  // namespace candil
