#include "apps/render_command.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "apps/exit_code.h"
#include "apps/frame_sequence.h"
#include "apps/interrupt.h"
#include "apps/messages.h"
#include "apps/render_picture.h"

namespace candil {

int run_render(const RenderOptions& asked) {
  if (asked.frames) return run_frame_sequence(asked);
  const PlannedFiles files = plan_files(asked);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(asked.settings.threads));
  tbb::task_arena arena(asked.settings.threads);
  const std::unique_ptr<PreparedScene> prepared = arena.execute([&] { return prepare_scene(asked); });
  for (const std::string& warning : prepared->warnings) print_warning(warning);
  const std::atomic<bool>& stop = catch_interrupts();
  const bool is_finished = render_picture(*prepared, asked, files, stop, UnfinishedPicture::written);
  return is_finished ? exit_done : exit_interrupted;
}

}  // namespace candil
