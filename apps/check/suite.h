/// What a suite file asks for: scenes to render, and the golden images that they are to look like.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "metrics/comparison.h"

namespace candil {

/// When a render is not like its golden image any more. p-values are chances that noise alone differs so much.
struct CheckThresholds {
  double z_test = 1e-6;           ///< Smallest p-value of the z-test.
  double sign_test = 1e-6;        ///< Smallest p-value of the sign test.
  std::optional<double> flip;     ///< Largest mean FLIP; none: what the golden image's own noise suggests.
  std::vector<Threshold> others;  ///< Further metrics, only those that were asked for.
};

struct SuiteTest {
  std::string name;                ///< Letters, digits, '_', '-', '.': part of file names.
  std::filesystem::path scene;     ///< With the suite's folder in front.
  std::filesystem::path golden;    ///< Likewise; need not exist.
  bool makes_golden = true;        ///< --update writes it: the first test of the suite that names it.
  std::vector<std::string> words;  ///< Of the command line of `candil render`, after the scene.
  std::string environment;         ///< The image of --env with the suite's folder in front; empty: none.
  std::vector<std::string> tags;   ///< Sorted, each once.
  CheckThresholds thresholds;
  double time_limit_seconds = 60;  ///< For loading and rendering.
};

struct Suite {
  std::filesystem::path file;
  std::vector<SuiteTest> tests;  ///< In the order of the file, at least one.

  std::filesystem::path folder() const { return file.parent_path(); }
};

}  // namespace candil
