/// Text to JSON, for files that people write: comments are allowed, and mistakes are named.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace candil {

/// Parses JSON (RFC 8259) with // and /* */ comments and an optional byte order mark. Throws InputError(name, ...) with
/// line and column where it is malformed, has a number beyond double precision, names a key twice in one object, or
/// nests deeper than 64 levels.
nlohmann::json parse_json_with_comments(std::string_view text, const std::string& name);

/// Whether the text is an object that has the key; what comes after it is not looked at.
bool has_root_key(std::string_view text, std::string_view key);

}  // namespace candil
