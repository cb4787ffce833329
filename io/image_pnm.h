/// Portable float maps (PFM), without a library: OpenImageIO 2.4 cannot write them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace candil {

/// Colour PFM (PF), little-endian: `rgb` has three values per pixel, rows from top to bottom; the file stores them from
/// bottom to top.
std::vector<std::byte> encode_pfm(int width, int height, std::span<const float> rgb);

struct PfmImage {
  int width = 0, height = 0, channels = 0;  ///< 1 (Pf) or 3 (PF) channels.
  std::vector<float> values;                ///< Rows from top to bottom.
};

/// Reads a PFM of either byte order and at most `max_size` pixels on a side. Throws std::runtime_error with one line.
PfmImage decode_pfm(std::span<const std::byte> encoded, int max_size);

}  // namespace candil
