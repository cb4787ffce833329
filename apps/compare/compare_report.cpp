#include "apps/compare/compare_report.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "apps/base64.h"
#include "apps/compare/report_template.h"
#include "apps/escape_xml.h"
#include "core/color.h"
#include "io/image_file.h"
#include "metrics/color_map.h"
#include "metrics/parallel_rows.h"

namespace candil {
namespace {

using nlohmann::json;

/// JSON inside of a script element: nothing in it may look like the element's end.
std::string script_json(const json& value) {
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string safe;
  for (const char letter : text) letter == '<' ? safe += "\\u003c" : safe += letter;
  return safe;
}

/// What the report shows of values that are no colours in black and white.
struct Range {
  float low = 0, high = 1;
};

Range data_range(const ReportLayer& layer) {
  Range range{infinity, -infinity};
  for (const Image* image : {&layer.a, &layer.b})
    for (const float value : image->pixels)
      if (std::isfinite(value)) range = {std::min(range.low, value), std::max(range.high, value)};
  return range.low <= range.high ? range : Range{};
}

/// For browsers that run no scripts, and of 8-bit images the values themselves.
Image picture_of(const ReportLayer& layer, const Image& image, const Range& range) {
  Image picture(image.width, image.height, 3);
  for_each_row(image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const float value = image.pixel(x, y)[image.channels < 3 ? 0 : c];
        float& out = picture.pixel(x, y)[c];
        if (layer.kind == ValueKind::data)
          out = (value - range.low) / std::max(range.high - range.low, 1e-30f);
        else
          out = layer.kind == ValueKind::linear ? linear_to_srgb(std::clamp(value, 0.0f, 1.0f)) : value;
        if (!(out > 0)) out = 0;
      }
  });
  return picture;
}

/// Half floats, rounded to nearest; beyond their range infinite.
std::uint16_t half_of(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
  const float size = std::abs(value);
  if (std::isnan(value)) return static_cast<std::uint16_t>(sign | 0x7e00u);
  if (size >= 65520) return static_cast<std::uint16_t>(sign | 0x7c00u);
  // Below 2^-14 the step is 2^-24.
  if (size < 0x1p-14f) return static_cast<std::uint16_t>(sign | static_cast<std::uint16_t>(std::lrint(size * 0x1p24f)));
  const std::uint32_t rebiased = (bits & 0x7fffffffu) - (112u << 23);
  const std::uint32_t rounded = rebiased + 0xfffu + (rebiased >> 13 & 1u);  // ties to even
  return static_cast<std::uint16_t>(sign | rounded >> 13);
}

bool is_picture(const ReportLayer& layer) {
  return layer.is_8_bit && layer.kind == ValueKind::display && layer.a.channels == 3;
}

std::string encode_values(const ReportLayer& layer, const Image& image) {
  if (layer.kind != ValueKind::linear) return to_base64(std::as_bytes(std::span(image.pixels)));
  std::vector<std::uint16_t> halves(image.pixels.size());
  std::ranges::transform(image.pixels, halves.begin(), half_of);
  return to_base64(std::as_bytes(std::span(halves)));
}

/// Noise hardly gets smaller by trying harder, and a report is waited for.
constexpr int png_level = 2;

std::string image_element(const char* what, std::size_t index, const Image& picture) {
  return fmt::format(
      "<figure><figcaption>{0}</figcaption><img id=\"picture-{1}{2}\" alt=\"{0}\" "
      "src=\"data:image/png;base64,{3}\"></figure>\n",
      std::string_view(what) == "map" ? "Heat map"
      : std::string_view(what) == "a" ? "A"
                                      : "B",
      what, index, to_base64(encode_png(picture, false, png_level)));
}

std::string histogram_svg(const ReportLayer& layer) {
  constexpr int width = 512, height = 120;
  double largest = 1;
  for (const std::size_t count : layer.histogram) largest = std::max(largest, std::log1p(static_cast<double>(count)));
  const double bar = static_cast<double>(width) / static_cast<double>(std::max<std::size_t>(layer.histogram.size(), 1));
  std::string bars;
  for (std::size_t i = 0; i < layer.histogram.size(); ++i) {
    const double size = std::log1p(static_cast<double>(layer.histogram[i])) / largest * height;
    const auto& color = heat_colors()[std::min<std::size_t>(i * 256 / layer.histogram.size() + 32, 255)];
    bars += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"rgb({},{},{})\"/>",
                        bar * static_cast<double>(i), height - size, bar, size, color[0], color[1], color[2]);
  }
  return fmt::format(
      "<svg class=\"histogram\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\"><title>Pixels (logarithm of their "
      "number) by {2}</title>{3}"
      "<g fill=\"currentColor\" font-size=\"11\"><text x=\"0\" y=\"{4}\">{2} 0</text><text x=\"{0}\" y=\"{4}\" "
      "text-anchor=\"end\">{5:.4g}</text></g></svg>\n",
      width, height + 16, escape_xml(layer.map_name), bars, height + 13, layer.map_largest);
}

std::string layer_section(const Report& report, std::size_t index, const Range& range) {
  const ReportLayer& layer = report.layers[index];
  std::string text =
      fmt::format("<section class=\"layer\"><h2>{}</h2>\n<div class=\"pictures\">\n", escape_xml(layer.name));
  std::array<std::string, 3> elements;
  tbb::parallel_invoke([&] { elements[0] = image_element("a", index, picture_of(layer, layer.a, range)); },
                       [&] { elements[1] = image_element("b", index, picture_of(layer, layer.b, range)); },
                       [&] { elements[2] = image_element("map", index, heat_map(layer.map, layer.map_largest)); });
  for (const std::string& element : elements) text += element;
  text += "</div>\n" + histogram_svg(layer) + "<table>\n";
  for (const ReportRow& row : report.rows[index])
    text += fmt::format("<tr{}><th>{}</th><td>{}</td></tr>\n", row.is_bad ? " class=\"bad\"" : "", escape_xml(row.name),
                        escape_xml(row.value));
  return text + "</table></section>\n";
}

json layer_data(const ReportLayer& layer, const Range& range) {
  const char* const kind = layer.kind == ValueKind::display  ? "display"
                           : layer.kind == ValueKind::linear ? "linear"
                                                             : "data";
  const char* const format = is_picture(layer) ? "picture" : layer.kind == ValueKind::linear ? "half" : "float";
  return {{"name", layer.name},        {"kind", kind},
          {"format", format},          {"channels", layer.channels},
          {"width", layer.a.width},    {"height", layer.a.height},
          {"low", range.low},          {"high", range.high},
          {"mapName", layer.map_name}, {"mapLargest", layer.map_largest}};
}

/// The template with its marks replaced; what is filled in is not looked at again.
std::string fill_in(std::string_view text, const std::vector<std::pair<std::string_view, std::string_view>>& values) {
  std::string filled;
  while (true) {
    const std::size_t begin = text.find("{{");
    filled += text.substr(0, begin);
    if (begin == std::string_view::npos) return filled;
    const std::size_t end = text.find("}}", begin);
    const std::string_view mark = text.substr(begin + 2, end - begin - 2);
    for (const auto& [name, value] : values)
      if (name == mark) filled += value;
    text.remove_prefix(end + 2);
  }
}

}  // namespace

std::string make_report(const Report& report) {
  std::string sections, values, notes;
  json layers = json::array();
  for (std::size_t i = 0; i < report.layers.size(); ++i) {
    const ReportLayer& layer = report.layers[i];
    const Range range = layer.kind == ValueKind::data ? data_range(layer) : Range{};
    sections += layer_section(report, i, range);
    layers.push_back(layer_data(layer, range));
    if (is_picture(layer)) continue;
    std::string values_a, values_b;
    tbb::parallel_invoke([&] { values_a = encode_values(layer, layer.a); },
                         [&] { values_b = encode_values(layer, layer.b); });
    for (const auto& [letter, encoded] : {std::pair{'a', &values_a}, {'b', &values_b}}) {
      values += fmt::format("<script id=\"values-{}{}\" type=\"text/plain\">", letter, i);
      values += *encoded;
      values += "</script>\n";
    }
  }
  for (const std::string& note : report.notes) notes += "<li>" + escape_xml(note) + "</li>";
  if (!notes.empty()) notes = "<ul class=\"notes\">" + notes + "</ul>";
  const std::string heading =
      fmt::format("<h1 class=\"{}\">{}</h1>", report.is_same ? "same" : "different", escape_xml(report.verdict));
  const std::string names =
      fmt::format("<dt>A</dt><dd>{}</dd><dt>B</dt><dd>{}</dd>", escape_xml(report.name_a), escape_xml(report.name_b));
  const std::string title = escape_xml(report.title);
  const std::string data = script_json({{"layers", layers}, {"colors", heat_colors()}});
  return fill_in(report_html, {{"title", title},
                               {"css", report_css},
                               {"js", report_js},
                               {"heading", heading},
                               {"names", names},
                               {"notes", notes},
                               {"layers", sections},
                               {"values", values},
                               {"data", data}});
}

}  // namespace candil
