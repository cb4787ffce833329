/// The plainest formats of all, without a library: OpenImageIO 2.4 cannot write PFM.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace candil {

/// Binary PPM (P6) of 8 bits: `rgb` has three values per pixel, rows from top to bottom.
std::vector<std::byte> encode_ppm(int width, int height, std::span<const std::uint8_t> rgb);

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
