/// The container of PNG files: chunks of a length, a name, data and a checksum.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace candil {

/// The same PNG with nothing but the chunks that pixels are made of (IHDR, PLTE, tRNS, IDAT, IEND). What textures must
/// ignore (gamma, colour profiles) and what nobody asked for (compressed texts) never reaches the decoder, which would
/// complain about it on standard error. Throws std::runtime_error when the file is cut short or a checksum is wrong.
std::vector<std::byte> keep_png_pixels(std::span<const std::byte> encoded);

}  // namespace candil
