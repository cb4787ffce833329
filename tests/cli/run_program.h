/// Runs the real program and catches what it says.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace candil::test {

struct ProgramResult {
  int exit_code = -1;          ///< -1 when a signal ended it.
  int signal = 0;              ///< The signal that ended it, or 0.
  std::string output, errors;  ///< Standard output and standard error.
};

/// A run of the program that may still be going on, in a folder of its own choice as the current one.
class RunningProgram {
 public:
  RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                 const std::string& program = CANDIL_BINARY);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// Waits until standard error holds `text`, at most half a minute; false if it never did.
  bool wait_for(const std::string& text) const;
  /// Likewise for standard output.
  bool wait_for_output(const std::string& text) const;
  void send(int signal) const;
  ProgramResult wait();

 private:
  bool wait_for(const std::string& text, const char* stream) const;

  TemporaryFolder streams_;
  pid_t process_ = -1;
};

/// Runs to the end.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const std::string& program = CANDIL_BINARY);

/// Writes `square.gltf`, a textureless square of 2 x 2 metres facing +Z in a self-contained file, and returns its
/// path. It has no light and no camera.
std::filesystem::path write_square_scene(const TemporaryFolder& folder);

/// Lines that begin with "error: ".
int count_errors(const ProgramResult& result);

}  // namespace candil::test
