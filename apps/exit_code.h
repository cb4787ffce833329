/// What the process says to the shell.
#pragma once

namespace candil {

enum ExitCode : int {
  exit_done = 0,
  exit_difference = 1,    ///< A comparison found one.
  exit_usage = 2,         ///< The command line is wrong.
  exit_input = 3,         ///< The input cannot be used.
  exit_output = 4,        ///< The output cannot be written.
  exit_internal = 70,     ///< A mistake in candil itself, or no memory left.
  exit_interrupted = 130  ///< Ctrl-C or SIGTERM; what was there is written.
};

}  // namespace candil
