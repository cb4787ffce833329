/// What a measurement was made on.
#pragma once

#include <string>

namespace candil {

struct Machine {
  std::string processor;          ///< As it calls itself.
  unsigned hardware_threads = 0;  ///< That this process may use.
  double load = 0;                ///< Mean number of running threads in the last minute, before the measurement.
  std::string compiler;           ///< That candil was built with.
};

Machine this_machine();

}  // namespace candil
