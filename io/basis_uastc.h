/// UASTC, a block format of 4 x 4 texels in 16 bytes whose 19 modes are a part of ASTC with an order of bits of its
/// own: "UASTC LDR 4x4 Texture Specification", Basis Universal.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace candil {

inline constexpr std::size_t uastc_block_bytes = 16;

/// The texels of a block, rows from top to bottom; nothing if it is none. Values lie between the endpoints as in ASTC
/// for linear data, whatever the colour space, as the format's own transcoder has it: for sRGB they are at most one
/// level from what ASTC hardware shows.
std::optional<std::array<glm::u8vec4, 16>> decode_uastc_block(std::span<const std::byte, uastc_block_bytes> block);

}  // namespace candil
