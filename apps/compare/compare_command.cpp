#include "apps/compare/compare_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "apps/compare/compare_report.h"
#include "apps/compare/compare_result.h"
#include "apps/exit_code.h"
#include "apps/messages.h"
#include "apps/usage_error.h"
#include "io/atomic_file.h"
#include "io/error.h"
#include "io/image_file.h"
#include "metrics/color_map.h"
#include "metrics/map_statistics.h"

namespace candil {
namespace {

namespace fs = std::filesystem;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code status;
  return fs::equivalent(a, b, status) && !status;
}

/// Before anything is read: formats, folders, and no output in the place of an input.
void check_outputs(const CompareOptions& options) {
  if (!options.diff.empty() && !is_writable_image(options.diff))
    throw UsageError(fmt::format("--diff: {}: unknown format; use .png, .jpg, .tif, .ppm, .exr, .hdr or .pfm",
                                 options.diff.string()));
  const fs::path json = options.json == "-" ? fs::path() : fs::path(options.json);
  for (const auto& [option, path] : {std::pair{"--diff", options.diff}, {"--html", options.html}, {"--json", json}}) {
    if (path.empty()) continue;
    for (const fs::path& input : {options.a, options.b, options.mask})
      if (is_same_file(path, input))
        throw UsageError(fmt::format("{0}: {1} is an input; choose another name with {0}", option, path.string()));
    check_writable(path);
  }
}

/// What is to be looked at: FLIP, or of layers without colours the error.
struct ShownMap {
  const Image& map;
  const char* name;
  float largest;
};

ShownMap map_of(const LayerResult& result) {
  const Comparison& comparison = result.comparison;
  if (comparison.flip) return {comparison.flip->map, "FLIP", 1};
  const double shares[] = {1.0};
  const float largest = map_quantiles(comparison.differences.error, comparison.selection, shares).front();
  return {comparison.differences.error, "error", largest > 0 && largest < infinity ? largest : 1};
}

void write_diff(const fs::path& path, const LayerResult& result) {
  const ShownMap shown = map_of(result);
  if (!is_linear_format(path)) return write_image(path, heat_map(shown.map, shown.largest), false, {});
  Image values(shown.map.width, shown.map.height, 3);
  for (std::size_t i = 0; i < values.pixels.size(); ++i) values.pixels[i] = shown.map.pixels[i / 3];
  write_image(path, values, false, {});
}

/// The lines about a layer as rows: "  name value".
std::vector<ReportRow> report_rows(const LayerPair& layer, const LayerResult& result) {
  std::vector<ReportRow> rows;
  for (const MetricLine& line : describe_metrics(layer, result)) rows.push_back({line.name, line.words, false});
  for (const Judgement& judgement : result.judgements)
    rows.push_back({measure_name(judgement.threshold.measure), describe_judgement(judgement), !judgement.is_met});
  return rows;
}

void write_report(const CompareOptions& options, const CompareInputs& inputs, const CompareResult& result) {
  Report report;
  report.name_a = options.a.string(), report.name_b = options.b.string();
  report.title = fmt::format("{} | {}", options.a.filename().string(), options.b.filename().string());
  report.verdict = verdict(result, inputs);
  report.is_same = result.is_same();
  report.notes = inputs.notes;
  for (std::size_t i = 0; i < inputs.layers.size(); ++i) {
    const LayerPair& layer = inputs.layers[i];
    const ShownMap shown = map_of(result.layers[i]);
    constexpr int bins = 128;
    report.layers.push_back({layer.name, layer.channels, layer.kind, layer.is_8_bit, layer.a, layer.b, shown.map,
                             shown.name, shown.largest,
                             map_histogram(shown.map, result.layers[i].comparison.selection, 0, shown.largest, bins)});
    report.rows.push_back(report_rows(layer, result.layers[i]));
  }
  write_file_atomically(options.html, make_report(report));
}

void print(std::FILE* stream, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stream) != text.size() || std::fflush(stream) != 0)
    throw OutputError("standard output", "cannot be written");
}

/// Names may hold anything; a terminal is not told what to do. Lines stay lines.
std::string printable_lines(const std::string& text) {
  std::string lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines += printable(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return lines;
}

}  // namespace

int run_compare(const CompareOptions& options) {
  check_outputs(options);
  const CompareInputs inputs = read_compare_inputs(options);
  const PixelSelection selection = select_pixels(options, inputs.width, inputs.height);
  const CompareResult result = compare_layers(options, inputs, selection);
  // The numbers first: they are there whatever happens to the files.
  if (options.json == "-") print(stdout, result_json(options, inputs, result));
  if (!options.is_quiet)
    print(options.json == "-" ? stderr : stdout, printable_lines(describe_result(options, inputs, result)));
  if (!options.json.empty() && options.json != "-")
    write_file_atomically(options.json, result_json(options, inputs, result));
  if (!options.diff.empty()) write_diff(options.diff, result.layers.front());
  if (!options.html.empty()) write_report(options, inputs, result);
  return result.is_same() ? exit_done : exit_difference;
}

}  // namespace candil
