/// Tells a person on standard error how far a render is.
#pragma once

#include <string>

#include "integrators/render.h"

namespace candil {

/// On a terminal one line that is rewritten; otherwise a plain line at the start and about every ten seconds; when
/// quiet, nothing. Called from one thread at a time.
class Progress {
 public:
  Progress(bool is_quiet, const RenderSettings& settings);

  void start(const std::string& scene_name);
  void update(const RenderProgress& progress);
  /// Clears the line on a terminal. Call before anything else is printed.
  void finish();

 private:
  enum class Kind { none, plain, terminal };
  std::string describe(const RenderProgress& progress) const;
  double fraction(const RenderProgress& progress) const;

  Kind kind_;
  RenderSettings settings_;
  double next_update_seconds_ = 0;
};

}  // namespace candil
