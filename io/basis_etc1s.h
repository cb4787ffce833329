/// ETC1S pictures under BasisLZ: KTX File Format Specification 2.0, appendices "BasisLZ Global Data" and "BasisLZ/ETC1S
/// Bitstream". A picture is a grid of blocks of 4 x 4 texels; a block names an entry of a palette of endpoints (a base
/// colour and how far its four shades lie apart) and one of a palette of selectors (which texel has which shade).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "io/basis_huffman.h"

namespace candil {

/// The parts of the global data, in bytes of the file.
struct Etc1sPalettes {
  std::uint32_t endpoint_count = 0, selector_count = 0;
  std::span<const std::byte> endpoints, selectors, tables;
};

class Etc1sDecoder {
 public:
  /// Throws std::runtime_error where the palettes cannot be read.
  explicit Etc1sDecoder(const Etc1sPalettes& palettes);

  /// The blocks of a slice, row by row from the top: 16 texels each, rows from top to bottom, alpha 255. Calls
  /// `place(column, row, texels)` once per block. Throws std::runtime_error where the slice is damaged.
  template <typename Place>
  void decode(std::span<const std::byte> slice, std::uint32_t columns, std::uint32_t rows, const Place& place) const {
    SliceReader reader(*this, slice, columns);
    for (std::uint32_t row = 0; row < rows; ++row) {
      for (std::uint32_t column = 0; column < columns; ++column) place(column, row, reader.next(column, row));
    }
  }

 private:
  using Texel = glm::u8vec4;
  using Block = std::array<Texel, 16>;
  using Shades = std::array<Texel, 4>;

  /// What is known of a slice while its blocks are read in order.
  class SliceReader {
   public:
    SliceReader(const Etc1sDecoder& decoder, std::span<const std::byte> slice, std::uint32_t columns);
    Block next(std::uint32_t column, std::uint32_t row);

   private:
    void read_predictions(std::uint32_t column, std::uint32_t row);
    std::uint32_t next_endpoint(std::uint32_t column, std::uint32_t row);
    std::uint32_t next_selector();
    std::uint32_t recent_selector(std::uint32_t index);

    const Etc1sDecoder& decoder_;
    BasisBitReader bits_;
    std::vector<std::uint16_t> upper_endpoints_;  // of the blocks to the right in the row above, and left in this one
    std::uint32_t upper_left_endpoint_ = 0, left_endpoint_ = 0;
    std::vector<std::uint8_t> lower_predictions_;  // of the odd row of each 2 x 2 blocks
    std::uint32_t predictions_ = 0, last_predictions_ = 0, prediction_repeats_ = 0;
    std::vector<std::uint16_t> recent_;  // selectors, roughly by how lately they were used
    std::uint32_t recent_end_ = 0, selector_repeats_ = 0;
  };

  void read_endpoints(const Etc1sPalettes& palettes);
  void read_selectors(const Etc1sPalettes& palettes);

  std::vector<Shades> endpoints_;
  std::vector<std::uint32_t> selectors_;  // 2 bits for each texel, the upper left one lowest
  BasisBitReader tables_;
  BasisHuffmanCode prediction_code_, endpoint_code_, selector_code_, repeat_code_;
  std::uint32_t recent_count_ = 0;
};

}  // namespace candil
