/// Bytes as text.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace candil {

/// RFC 4648, section 4.
std::string to_base64(std::span<const std::byte> bytes);

}  // namespace candil
