/// Letters for drawings that have no font library: ASCII in 5 x 7 pixels, and 2 below the base line.
#pragma once

#include <array>
#include <cstdint>

namespace candil {

inline constexpr int glyph_width = 5, glyph_height = 9;
/// Rows above the base line.
inline constexpr int glyph_ascent = 7;

/// Rows from the top; bit 4 is the leftmost pixel.
using Glyph = std::array<std::uint8_t, glyph_height>;

/// Of any character outside of printable ASCII: a box.
const Glyph& glyph_of(char c);

}  // namespace candil
