/// Bytes that a scene file refers to: other files and data URIs. Nothing outside the scene's folder is ever read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace candil {

using Bytes = std::vector<std::byte>;

/// Text from a file as a message can show it: cut where it is long, control characters replaced.
std::string printable(std::string_view text);
/// A name as a scene keeps it: cut after 200 bytes, between characters of UTF-8, since every instance has a copy.
std::string kept_name(std::string_view text);
/// As printable(), in quotation marks.
std::string quoted_text(std::string_view text);

/// The whole of a file. Throws InputError(path, place, ...) when it cannot be read; `name` is how messages call the
/// scene file, `place` the reference in it (empty: the scene file itself).
Bytes read_file(const std::filesystem::path& path, const std::string& name, const std::string& place);

/// The file that the relative reference `uri` (RFC 3986, percent-encoded) means. Refuses, by InputError(name, place,
/// ...), other schemes, absolute paths, drive letters, paths that leave `folder` by `..` or through a symbolic link,
/// what does not exist and what is not a regular file (a pipe or device could block for ever).
std::filesystem::path resolve_reference(const std::filesystem::path& folder, std::string_view uri,
                                        const std::string& name, const std::string& place);

bool is_data_uri(std::string_view uri);

/// The bytes of a `data:` URI (RFC 2397), base64 or percent-encoded; the media type is ignored. Throws
/// InputError(name, place, ...) when it is malformed.
Bytes decode_data_uri(std::string_view uri, const std::string& name, const std::string& place);

/// decode_data_uri() or read_file(resolve_reference()), as the URI demands. The file, if any, is added to `files`.
Bytes read_reference(const std::filesystem::path& folder, std::string_view uri, const std::string& name,
                     const std::string& place, std::vector<std::filesystem::path>& files);

}  // namespace candil
