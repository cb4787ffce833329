/// Whether a render still looks like its golden image.
#pragma once

#include <string>
#include <vector>

#include "apps/check/golden_file.h"
#include "apps/check/suite.h"
#include "core/tonemap.h"

namespace candil {

/// One number, and what it may be.
struct Finding {
  std::string name;  ///< "ztest", "flip:p99"
  double value = 0, limit = 0;
  double log10_value = 0;    ///< Of p-values, which may be too small for a number.
  bool is_smallest = false;  ///< The limit is the least that is put up with, as for p-values; else the most.
  bool is_met = true;
  /// How far beyond: 1 at the limit, larger is worse; of p-values the ratio of their logarithms.
  double severity = 0;
};

struct Verdict {
  std::vector<Finding> findings;
  std::vector<std::string> notes;  ///< Where the difference is, what else has changed.
  std::string failure;             ///< That no number tells, such as another size; empty: none.
  double mean_change = 0;          ///< Of the mean of all values, as a share of it: positive is brighter.
  std::optional<Image> flip_map;   ///< One channel, 0 to 1.

  bool is_passed() const;
  /// The largest of the findings; beyond all numbers where there is a `failure`.
  double severity() const;
};

/// The operator and the exposure of a test, where it asks for them.
struct DisplayRequest {
  Tonemap tonemap;
  float exposure = 0;
};

/// Both are rounded. `request`: the golden image has a display layer to hold against what is made of its mean now.
Verdict judge_render(const GoldenImage& golden, const GoldenImage& render, const CheckThresholds& thresholds,
                     const std::optional<DisplayRequest>& request);

/// Mean FLIP between two renders: what the noise of a golden image is held to be.
double mean_flip(const GoldenImage& a, const GoldenImage& b);

}  // namespace candil
