/// One picture of a scene that is prepared: rendered, written, reported.
#pragma once

#include <atomic>
#include <vector>

#include "apps/outputs.h"
#include "apps/render_steps.h"

namespace candil {

/// The files that the options of a render mean.
struct PlannedFiles {
  std::vector<Output> outputs, aovs;
};

/// Throws UsageError and OutputError for what cannot be written, and warns of formats that lack what is asked for.
PlannedFiles plan_files(const RenderOptions& options);

/// What becomes of a render that was interrupted.
enum class UnfinishedPicture { written, dropped };

/// True if it was not interrupted. Works on all threads of the settings.
bool render_picture(const PreparedScene& prepared, const RenderOptions& asked, const PlannedFiles& files,
                    const std::atomic<bool>& stop, UnfinishedPicture unfinished);

}  // namespace candil
