/// Ctrl-C and SIGTERM, turned into a flag that the render looks at.
#pragma once

#include <atomic>

namespace candil {

/// From now on the first SIGINT or SIGTERM only sets the flag that is returned; the next one ends the process at once.
/// A pipe that nobody reads any more becomes a write error instead of the end.
const std::atomic<bool>& catch_interrupts();

}  // namespace candil
