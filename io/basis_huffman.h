/// The Huffman codes of BasisLZ: KTX File Format Specification 2.0, appendix "BasisLZ/ETC1S Bitstream", section
/// "Compressed Huffman Tables".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/basis_bits.h"

namespace candil {

/// A canonical prefix code, as in RFC 1951, section 3.2.2.
class BasisHuffmanCode {
 public:
  /// Symbol i has a code of lengths[i] <= 16 bits, none if 0. Throws std::runtime_error unless the codes fill the space
  /// of all bit strings; a single symbol, and no symbol at all, are fine.
  explicit BasisHuffmanCode(std::span<const std::uint8_t> lengths);

  /// Reads a code as it is stored at the head of a section.
  static BasisHuffmanCode read(BasisBitReader& bits);

  /// The next symbol. Throws std::runtime_error where no code matches.
  std::uint32_t decode(BasisBitReader& bits) const {
    const Entry entry = fast_[bits.peek(fast_bits)];
    if (entry.length == 0) return decode_long(bits);
    bits.skip(entry.length);
    return entry.symbol;
  }

 private:
  static constexpr int longest = 16, fast_bits = 10;
  struct Entry {
    std::uint16_t symbol = 0;
    std::uint8_t length = 0;  ///< 0: longer than fast_bits, or no code.
  };
  std::uint32_t decode_long(BasisBitReader& bits) const;

  std::array<Entry, 1 << fast_bits> fast_;                                          // by the next bits of the stream
  std::array<std::uint32_t, longest + 1> first_code_{}, first_symbol_{}, count_{};  // by length
  std::vector<std::uint16_t> symbols_;                                              // in the order of their codes
};

}  // namespace candil
