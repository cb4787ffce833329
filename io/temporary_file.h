/// A file for libraries that read nothing else.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace candil {

/// Holds the bytes in the system's folder for temporary files, readable by this user alone, until destruction.
class TemporaryFile {
 public:
  /// Throws std::runtime_error with one line where it cannot be written.
  explicit TemporaryFile(std::span<const std::byte> bytes);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace candil
