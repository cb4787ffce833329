/// Files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace candil {

/// Writes to a new file beside `path` and renames it over `path`: a reader never sees half a file, and when anything
/// fails the old file stays as it was and nothing is left beside it. Throws OutputError.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> content);
void write_file_atomically(const std::filesystem::path& path, std::string_view text);

/// Throws OutputError when write_file_atomically() is bound to fail: no such folder, a folder in the place of the file,
/// no permission. Writes nothing.
void check_writable(const std::filesystem::path& path);

}  // namespace candil
