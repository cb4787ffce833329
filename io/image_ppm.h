/// Portable pixmaps (Netpbm's PPM), without a library, and their high-dynamic-range variant, which is known from
/// teaching renderers: plain P3 whose header has a comment `#MAX=<value>`; a stored integer v of a file of colour
/// resolution r stands for the linear value v MAX / r.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace candil {

/// Binary PPM (P6) of 8 bits: `rgb` has three values per pixel, rows from top to bottom.
std::vector<std::byte> encode_ppm(int width, int height, std::span<const std::uint8_t> rgb);

/// The same as text (P3).
std::vector<std::byte> encode_ascii_ppm(int width, int height, std::span<const std::uint8_t> rgb);

/// The high-dynamic-range variant, with the largest finite value as MAX (1 for a black image) and a resolution of
/// 1e9, the largest power of ten that fits other readers' 32 bits: the step is 1e-9 of MAX. Negative values and NaN are
/// stored as 0, infinity as MAX.
std::vector<std::byte> encode_hdr_ppm(int width, int height, std::span<const float> rgb);

struct PpmImage {
  int width = 0, height = 0;
  bool is_linear = false;     ///< The high-dynamic-range variant.
  std::vector<float> values;  ///< RGB, rows from top to bottom; not linear: [0, 1].
};

/// Reads P3 and P6 of 8 or 16 bits (maximum value 1 to 65535) and the high-dynamic-range variant (1 to 2^32 - 1), of at
/// most `max_size` pixels on a side. Comments may stand anywhere in the header and between the numbers of P3. Throws
/// std::runtime_error with one line that names the pixel where one is wrong.
PpmImage decode_ppm(std::span<const std::byte> encoded, int max_size);

}  // namespace candil
