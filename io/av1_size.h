/// The size of pictures in AV1 data.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace candil {

/// Width and height, in pixels, of every sequence that the data begin: AV1 Bitstream and Decoding Process
/// Specification, sections 5.3 (units) and 5.5 (sequence headers). Throws std::runtime_error with one line where they
/// cannot be told.
std::vector<std::pair<std::uint32_t, std::uint32_t>> av1_sizes(std::span<const std::byte> data);

}  // namespace candil
