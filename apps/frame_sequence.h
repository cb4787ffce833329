/// `candil render --frames`: one picture after the other from a scene file that is opened once.
#pragma once

#include "apps/command_options.h"

namespace candil {

/// Renders every frame of RenderOptions::frames. Returns an exit code; throws what run_render() does.
int run_frame_sequence(const RenderOptions& options);

}  // namespace candil
