#include <fmt/format.h>

#include "apps/chart.h"
#include "apps/escape_xml.h"

namespace candil {
namespace {

std::string color_name(ChartColor color) { return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b); }

const char* anchor_name(Chart::Anchor anchor) {
  switch (anchor) {
    case Chart::Anchor::left:
      return "start";
    case Chart::Anchor::middle:
      return "middle";
    case Chart::Anchor::right:
      return "end";
  }
  return "";
}

}  // namespace

std::string chart_svg(const Chart& chart) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\" "
      "font-family=\"sans-serif\" font-size=\"{2:g}\">\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n",
      chart.width, chart.height, chart_text_size);
  for (const Chart::Rectangle& r : chart.rectangles)
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", r.x, r.y,
                       r.width, r.height, color_name(r.color));
  for (const Chart::Text& t : chart.texts)
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\" fill=\"{}\">{}</text>\n", t.x, t.y,
                       anchor_name(t.anchor), color_name(t.color), escape_xml(t.text));
  return svg + "</svg>\n";
}

}  // namespace candil
