#include "io/temporary_file.h"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace candil {

TemporaryFile::TemporaryFile(std::span<const std::byte> bytes) {
  std::error_code status;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(status);
  path_ = ((status ? std::filesystem::path("/tmp") : folder) / "candil-XXXXXX").string();
  const int file = mkstemp(path_.data());
  if (file < 0) throw std::runtime_error("no temporary file " + path_ + ": " + std::generic_category().message(errno));
  bool is_written = true;
  while (is_written && !bytes.empty()) {
    const ssize_t count = write(file, bytes.data(), bytes.size());
    is_written = count > 0 || (count < 0 && errno == EINTR);
    if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  is_written = close(file) == 0 && is_written;
  if (is_written) return;
  unlink(path_.c_str());
  throw std::runtime_error("the temporary file " + path_ + " cannot be written");
}

TemporaryFile::~TemporaryFile() { unlink(path_.c_str()); }

}  // namespace candil
