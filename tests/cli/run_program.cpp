#include "tests/cli/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace candil::test {

RunningProgram::RunningProgram(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                               const std::string& program) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (streams_ / "out").c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (streams_ / "err").c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  const int status = posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (status != 0) throw std::runtime_error("cannot start " + words[0]);
}

RunningProgram::~RunningProgram() {
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

bool RunningProgram::wait_for(const std::string& text) const { return wait_for(text, "err"); }
bool RunningProgram::wait_for_output(const std::string& text) const { return wait_for(text, "out"); }

bool RunningProgram::wait_for(const std::string& text, const char* stream) const {
  using namespace std::chrono_literals;
  for (int i = 0; i < 3000; ++i) {
    if (read_text(streams_ / stream).find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

void RunningProgram::send(int signal) const { kill(process_, signal); }

ProgramResult RunningProgram::wait() {
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  ProgramResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.output = read_text(streams_ / "out");
  result.errors = read_text(streams_ / "err");
  return result;
}

ProgramResult run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                          const std::string& program) {
  return RunningProgram(arguments, folder, program).wait();
}

std::filesystem::path write_square_scene(const TemporaryFolder& folder) {
  // The buffer: positions (-1,-1,0) (1,-1,0) (1,1,0) (-1,1,0) as floats, then the indices 0 1 2 0 2 3 as 16 bits.
  write_text(folder / "square.gltf", R"({
    "asset": {"version": "2.0"},
    "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": "square"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"doubleSided": true,
                   "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.3, 0.2, 1], "metallicFactor": 0}}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"}]
  })");
  return folder / "square.gltf";
}

int count_errors(const ProgramResult& result) {
  std::istringstream lines(result.errors);
  int count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with("error: ");
  return count;
}

}  // namespace candil::test
