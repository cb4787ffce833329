/// What the command line asks `candil compare` for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "metrics/comparison.h"

namespace candil {

struct CompareOptions {
  std::filesystem::path a, b;
  std::vector<std::string> layers;  ///< Names, "picture" or "all"; empty: the picture.
  std::vector<Threshold> thresholds;
  std::vector<Region> regions;
  std::filesystem::path mask;  ///< Empty: none.
  bool resizes = false;        ///< B to the size of A.
  CompareSettings settings;
  std::string json;                  ///< A file, "-" for standard output; empty: none.
  std::filesystem::path diff, html;  ///< Empty: none.
  bool is_quiet = false;
};

}  // namespace candil
