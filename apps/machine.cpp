#include "apps/machine.h"

#include <stdlib.h>

#include <fstream>
#include <thread>

namespace candil {
namespace {

std::string processor_name() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return std::string("Clang ") + __clang_version__;
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.processor = processor_name();
  machine.hardware_threads = std::thread::hardware_concurrency();
  if (getloadavg(&machine.load, 1) != 1) machine.load = 0;
  machine.compiler = compiler_name();
  return machine;
}

}  // namespace candil
