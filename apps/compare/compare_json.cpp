#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/compare/compare_result.h"

namespace candil {
namespace {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(); }

const char* kind_name(ValueKind kind) {
  switch (kind) {
    case ValueKind::display:
      return "display";
    case ValueKind::linear:
      return "linear";
    case ValueKind::data:
      return "data";
  }
  return "";
}

json z_test_json(const LayerPair& layer, const ZTest& test) {
  const ZTest::Place& worst = test.worst;
  return {{"log10_p", test.log10_p_value},
          {"pixel_tests", test.pixel_tests},
          {"significant_pixel_tests", test.significant_pixel_tests},
          {"worst",
           {{"x", worst.region.x},
            {"y", worst.region.y},
            {"width", worst.region.width},
            {"height", worst.region.height},
            {"channel", channel_name(layer, worst.channel)},
            {"deviation", number(worst.deviation)},
            {"mean_a", number(worst.mean_a)},
            {"mean_difference", number(worst.mean_difference)}}}};
}

json layer_json(const LayerPair& layer, const LayerResult& result) {
  const Comparison& comparison = result.comparison;
  json metrics = json::object(), bias = json::object(), thresholds = json::array();
  for (const Measurement& measurement : result.summary)
    metrics[measure_name(measurement.measure)] = number(measurement.value);
  for (std::size_t c = 0; c < comparison.differences.bias.size(); ++c)
    bias[channel_name(layer, static_cast<int>(c))] = number(comparison.differences.bias[c]);
  for (const Judgement& judgement : result.judgements)
    thresholds.push_back({{"measure", measure_name(judgement.threshold.measure)},
                          {"limit", judgement.threshold.limit},
                          {"value", number(*judgement.value)},
                          {"met", judgement.is_met}});
  json text = {{"name", layer.name},
               {"kind", kind_name(layer.kind)},
               {"channels", layer.channels},
               {"same", result.is_same()},
               {"pixels", comparison.differences.pixels},
               {"non_finite_pixels", comparison.differences.non_finite_pixels},
               {"largest_at",
                {{"x", comparison.differences.largest_x},
                 {"y", comparison.differences.largest_y},
                 {"channel", channel_name(layer, comparison.differences.largest_channel)}}},
               {"metrics", metrics},
               {"bias", bias},
               {"thresholds", thresholds}};
  if (comparison.flip && comparison.flip->exposures)
    text["flip_exposures"] = {{"start", comparison.flip->exposures->start},
                              {"stop", comparison.flip->exposures->stop},
                              {"count", comparison.flip->exposures->count}};
  if (comparison.z_test) text["ztest"] = z_test_json(layer, *comparison.z_test);
  return text;
}

}  // namespace

std::string result_json(const CompareOptions& options, const CompareInputs& inputs, const CompareResult& result) {
  json layers = json::array();
  for (std::size_t i = 0; i < inputs.layers.size(); ++i)
    layers.push_back(layer_json(inputs.layers[i], result.layers[i]));
  const json text = {{"a", options.a.string()}, {"b", options.b.string()},  {"width", inputs.width},
                     {"height", inputs.height}, {"same", result.is_same()}, {"verdict", verdict(result, inputs)},
                     {"notes", inputs.notes},   {"layers", layers}};
  // Names out of hostile files need not be UTF-8.
  return text.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace candil
