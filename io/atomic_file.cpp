#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "io/error.h"

namespace candil {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// A new, empty file of a unique name beside the target; removed again unless it became the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target) {
    name_ = (folder_of(target) / ("." + target.filename().string() + ".XXXXXX")).string();
    descriptor_ = mkstemp(name_.data());
    if (descriptor_ < 0) fail();
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!name_.empty()) unlink(name_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::span<const std::byte> content) {
    while (!content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail();
      content = content.subspan(static_cast<std::size_t>(written));
    }
  }

  void become_target() {
    // mkstemp() lets only the owner read; give the rights that an ordinary new file would have.
    const mode_t mask = umask(0);
    umask(mask);
    if (fchmod(descriptor_, 0666 & ~mask) != 0) fail();
    const int closing = std::exchange(descriptor_, -1);
    if (close(closing) != 0 || rename(name_.c_str(), target_.c_str()) != 0) fail();
    name_.clear();
  }

 private:
  [[noreturn]] void fail() const {
    throw OutputError(target_.string(), std::string("cannot be written: ") + std::strerror(errno));
  }

  std::filesystem::path target_;
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content) {
  TemporaryFile file(path);
  file.write(content);
  file.become_target();
}

void write_file_atomically(const std::filesystem::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text)));
}

void check_writable(const std::filesystem::path& path) {
  const std::filesystem::path folder = folder_of(path);
  std::error_code status;
  if (!path.has_filename() || std::filesystem::is_directory(path, status))
    throw OutputError(path.string(), "cannot be written: it is a folder");
  if (!std::filesystem::is_directory(folder, status))
    throw OutputError(path.string(), "cannot be written: there is no folder " + folder.string());
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError(path.string(), "cannot be written: " + folder.string() + ": " + std::strerror(errno));
}

}  // namespace candil
