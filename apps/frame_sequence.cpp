#include "apps/frame_sequence.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <set>

#include "apps/exit_code.h"
#include "apps/frame_names.h"
#include "apps/interrupt.h"
#include "apps/messages.h"
#include "apps/render_picture.h"
#include "apps/usage_error.h"
#include "io/error.h"

namespace candil {
namespace {

/// The options of a still of that frame.
RenderOptions options_of_frame(const RenderOptions& asked, std::uint32_t frame) {
  RenderOptions options = asked;
  options.frames.reset();
  options.load.at = frame / asked.frames_per_second;
  if (options.outputs.empty()) options.outputs.push_back(asked.scene.stem().string() + ".png");
  for (std::string& output : options.outputs) {
    if (output == "-") throw UsageError("-o -: standard output takes one picture, not a sequence");
    output = frame_name("-o", output, frame);
  }
  if (!asked.statistics.empty()) options.statistics = frame_name("--stats", asked.statistics.string(), frame);
  return options;
}

}  // namespace

int run_frame_sequence(const RenderOptions& asked) {
  const FrameRange range = *asked.frames;
  plan_files(options_of_frame(asked, range.first));  // what is wrong with names is said before the scene is read
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(asked.settings.threads));
  tbb::task_arena arena(asked.settings.threads);
  const std::atomic<bool>& stop = catch_interrupts();
  SceneSequence sequence(asked.scene, asked.load);
  std::unique_ptr<PreparedScene> prepared;
  std::set<std::string> warnings;  // that were printed
  for (std::uint32_t frame = range.first; frame <= range.last; ++frame) {
    const RenderOptions options = options_of_frame(asked, frame);
    const PlannedFiles files = plan_files(options);
    prepared = arena.execute([&] { return prepare_frame(options, sequence, std::move(prepared)); });
    for (const std::string& warning : prepared->warnings)
      if (warnings.insert(warning).second) print_warning(warning);
    // A picture of a part of its samples among whole ones would be seen in the film: it is not written.
    if (stop || !render_picture(*prepared, options, files, stop, UnfinishedPicture::dropped)) {
      if (!asked.is_quiet) print_note(fmt::format("stopped before frame {} of {}-{}", frame, range.first, range.last));
      return exit_interrupted;
    }
  }
  return exit_done;
}

}  // namespace candil
