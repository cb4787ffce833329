/// Colours for numbers.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"

namespace candil {

/// 256 colours (sRGB bytes) from black through violet and orange to a pale yellow, ever lighter: the look of the magma
/// map that FLIP's authors show errors in. No two are the same.
const std::array<std::array<std::uint8_t, 3>, 256>& heat_colors();

/// The map in these colours: values from 0 (black) to `largest` and beyond (the lightest); NaN too is the lightest.
/// Three channels of display values.
Image heat_map(const Image& map, float largest = 1);

}  // namespace candil
