#include "io/resource.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <optional>

#include "io/error.h"

namespace candil {

namespace fs = std::filesystem;

namespace {

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A percent sign that is not followed by two hexadecimal digits stands for itself: exporters write such names.
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_escape =
        text[i] == '%' && i + 2 < text.size() && hex_value(text[i + 1]) >= 0 && hex_value(text[i + 2]) >= 0;
    if (is_escape) {
      decoded += static_cast<char>(16 * hex_value(text[i + 1]) + hex_value(text[i + 2]));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// "http", "file", "c" (a drive letter) of a reference that has a scheme (RFC 3986, section 3.1).
std::optional<std::string_view> scheme_of(std::string_view uri) {
  const std::size_t colon = uri.find_first_of(":/?#\\");
  if (colon == 0 || colon == std::string_view::npos || uri[colon] != ':') return {};
  const std::string_view scheme = uri.substr(0, colon);
  const auto is_allowed = [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; };
  const bool is_scheme =
      std::isalpha(static_cast<unsigned char>(scheme[0])) && std::all_of(scheme.begin(), scheme.end(), is_allowed);
  return is_scheme ? std::optional(scheme) : std::nullopt;
}

/// True when `path` (canonical) lies in `folder` (canonical) or below.
bool is_inside(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Why `relative` may not be read, empty if it may; looks at the text only.
std::string refusal(const std::string& relative) {
  if (relative.empty()) return "is empty";
  if (relative.find('\0') != std::string::npos) return "contains a zero byte";
  if (scheme_of(relative)) return "has a scheme or drive letter; only files beside the scene are read";
  if (relative[0] == '/' || relative[0] == '\\') return "is an absolute path; only files beside the scene are read";
  std::string slashes = relative;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const fs::path normal = fs::path(slashes).lexically_normal();
  if (!normal.empty() && *normal.begin() == "..") return "leaves the folder of the scene file";
  return {};
}

constexpr std::array<std::int8_t, 256> make_base64_table() {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> table{};
  table.fill(-1);
  for (std::size_t i = 0; i < alphabet.size(); ++i) table[static_cast<unsigned char>(alphabet[i])] = std::int8_t(i);
  return table;
}

std::optional<Bytes> decode_base64(std::string_view text) {
  static constexpr std::array<std::int8_t, 256> table = make_base64_table();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return {};
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int value = table[static_cast<unsigned char>(c)];
    if (value < 0) return {};
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xff));
    }
  }
  return bytes;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 80;
  std::string shown(text.substr(0, longest));
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text.size() > longest ? shown + "..." : shown;
}

std::string kept_name(std::string_view text) {
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  const auto is_continuation = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
  while (end > longest - 3 && is_continuation(text[end])) --end;
  return std::string(text.substr(0, end));
}

std::string quoted_text(std::string_view text) { return '"' + printable(text) + '"'; }

Bytes read_file(const fs::path& path, const std::string& name, const std::string& place) {
  const std::string subject = place.empty() ? std::string("the file ") : quoted_text(path.filename().string()) + " ";
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(name, place, subject + "does not exist");
  if (!fs::is_regular_file(status)) throw InputError(name, place, subject + "is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) throw InputError(name, place, subject + "cannot be opened for reading");
  Bytes bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
    throw InputError(name, place, subject + "cannot be read to its end");
  }
  return bytes;
}

fs::path resolve_reference(const fs::path& folder, std::string_view uri, const std::string& name,
                           const std::string& place) {
  const auto fail = [&](const std::string& why) -> InputError { return {name, place, quoted_text(uri) + " " + why}; };
  if (scheme_of(uri)) throw fail("has a scheme or drive letter; only files beside the scene are read");

  std::error_code error;
  const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error) throw fail("cannot be looked up: the folder of the scene is not readable");
  // Some exporters write names as they are: a file that really is called "a%20b.png" comes second.
  for (const std::string& relative : {percent_decoded(uri), std::string(uri)}) {
    const std::string why = refusal(relative);
    if (!why.empty()) throw fail(why);
    const fs::path path = fs::canonical(root / relative, error);
    if (error) continue;
    if (!is_inside(root, path)) throw fail("leads out of the folder of the scene file");
    if (!fs::is_regular_file(path, error)) throw fail("is not a regular file");
    return path;
  }
  throw fail("does not exist");
}

bool is_data_uri(std::string_view uri) {
  constexpr std::string_view prefix = "data:";
  return uri.size() >= prefix.size() && std::equal(prefix.begin(), prefix.end(), uri.begin(), [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

Bytes decode_data_uri(std::string_view uri, const std::string& name, const std::string& place) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) throw InputError(name, place, "the data URI has no comma");
  const std::string_view payload = uri.substr(comma + 1);
  if (!uri.substr(0, comma).ends_with(";base64")) {
    const std::string text = percent_decoded(payload);
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return Bytes(first, first + text.size());
  }
  std::optional<Bytes> bytes = decode_base64(payload);
  if (!bytes) throw InputError(name, place, "the data URI is not valid base64");
  return std::move(*bytes);
}

Bytes read_reference(const fs::path& folder, std::string_view uri, const std::string& name, const std::string& place,
                     std::vector<fs::path>& files) {
  if (is_data_uri(uri)) return decode_data_uri(uri, name, place);
  files.push_back(resolve_reference(folder, uri, name, place));
  return read_file(files.back(), name, place);
}

}  // namespace candil
