/// Zstandard (RFC 8878) by libzstd.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace candil {

/// The `size` bytes that `compressed` holds; no more memory than that is used for them, whatever its own header claims.
/// Throws std::runtime_error with one line where it is damaged or of another size, or where there is no
/// libzstd.
std::vector<std::byte> decompress_zstandard(std::span<const std::byte> compressed, std::size_t size);

}  // namespace candil
