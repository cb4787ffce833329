/// The one exception type of io/: a file that cannot be used or written.
#pragma once

#include <stdexcept>
#include <string>

namespace candil {

/// The input cannot be used (exit code 3). what() is one line: file, place in it, what is wrong.
class InputError : public std::runtime_error {
 public:
  /// `place` may be empty, or name a place in the file: "materials[3].normalTexture.index".
  InputError(const std::string& file, const std::string& place, const std::string& message)
      : std::runtime_error(file + ": " + (place.empty() ? "" : place + ": ") + message) {}
};

/// The output cannot be written (exit code 4). what() is one line.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& file, const std::string& message) : std::runtime_error(file + ": " + message) {}
};

}  // namespace candil
