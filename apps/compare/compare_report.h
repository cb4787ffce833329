/// A report in one HTML file that needs nothing else: no network, no other file.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "metrics/image_pair.h"

namespace candil {

/// One pair of images in a report.
struct ReportLayer {
  std::string name;
  std::vector<std::string> channels;
  ValueKind kind = ValueKind::linear;
  bool is_8_bit = false;  ///< The values are multiples of 1/255: pictures of 8 bits hold them.
  const Image& a;
  const Image& b;
  const Image& map;                    ///< One channel: what the heat map shows.
  std::string map_name;                ///< "flip", "error".
  float map_largest = 1;               ///< What is shown in the lightest colour.
  std::vector<std::size_t> histogram;  ///< Of the map's values from 0 to map_largest.
};

struct ReportRow {
  std::string name, value;
  bool is_bad = false;
};

struct Report {
  std::string title, name_a, name_b, verdict;
  bool is_same = false;
  std::vector<std::string> notes;
  std::vector<ReportLayer> layers;
  std::vector<std::vector<ReportRow>> rows;  ///< For each layer what has been measured.
};

/// The text of the file.
std::string make_report(const Report& report);

}  // namespace candil
