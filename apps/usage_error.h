/// The command line asks for what does not exist or does not go together (exit code 2).
#pragma once

#include <stdexcept>

namespace candil {

class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace candil
