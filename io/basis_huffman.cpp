#include "io/basis_huffman.h"

#include <algorithm>
#include <stdexcept>

namespace candil {
namespace {

/// The first bit of a code is the lowest of the stream: a code as a number has its bits the other way round.
std::uint32_t reversed(std::uint32_t code, int length) {
  std::uint32_t result = 0;
  for (int i = 0; i < length; ++i) result |= (code >> i & 1) << (length - 1 - i);
  return result;
}

}  // namespace

BasisHuffmanCode::BasisHuffmanCode(std::span<const std::uint8_t> lengths) {
  for (const std::uint8_t length : lengths) ++count_[length];
  count_[0] = 0;
  std::uint32_t code = 0, symbol = 0;
  for (std::size_t length = 1; length <= longest; ++length) {
    code = (code + count_[length - 1]) << 1;
    first_code_[length] = code;
    first_symbol_[length] = symbol;
    symbol += count_[length];
    if (code + count_[length] > 1u << length) throw std::runtime_error("a Huffman code has too many words");
  }
  if (symbol > 1 && code + count_[longest] != 1u << longest)
    throw std::runtime_error("a Huffman code has too few words");

  symbols_.resize(symbol);
  std::array<std::uint32_t, longest + 1> used{};
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const std::uint8_t length = lengths[i];
    if (length == 0) continue;
    const std::uint32_t place = used[length]++;
    symbols_[first_symbol_[length] + place] = static_cast<std::uint16_t>(i);
    if (length > fast_bits) continue;
    const Entry entry{static_cast<std::uint16_t>(i), length};
    const std::uint32_t start = reversed(first_code_[length] + place, length);
    for (std::uint32_t bits = start; bits < fast_.size(); bits += 1u << length) fast_[bits] = entry;
  }
}

std::uint32_t BasisHuffmanCode::decode_long(BasisBitReader& bits) const {
  const std::uint32_t ahead = bits.peek(longest);
  std::uint32_t code = 0;
  for (int length = 1; length <= longest; ++length) {
    code = code << 1 | (ahead >> (length - 1) & 1);
    const auto i = static_cast<std::size_t>(length);
    if (code < first_code_[i] || code - first_code_[i] >= count_[i]) continue;
    bits.skip(length);
    return symbols_[first_symbol_[i] + (code - first_code_[i])];
  }
  throw std::runtime_error("no Huffman code matches");
}

BasisHuffmanCode BasisHuffmanCode::read(BasisBitReader& bits) {
  const std::uint32_t symbol_count = bits.read(14);
  if (symbol_count == 0)
    return BasisHuffmanCode(std::span<const std::uint8_t>());  // encoders write this for codes that they do not use

  // The lengths are themselves coded: 0 to 16 stand for themselves, the rest for runs.
  constexpr std::array<std::uint8_t, 21> order = {17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                  11, 4,  12, 3,  13, 2, 14, 1, 15, 16};
  constexpr std::uint32_t few_zeros = 17, many_zeros = 18, few_repeats = 19;
  const std::uint32_t stored = bits.read(5);
  if (stored < 1 || stored > order.size()) throw std::runtime_error("a Huffman code of code lengths is damaged");
  std::array<std::uint8_t, order.size()> length_lengths{};
  for (std::uint32_t i = 0; i < stored; ++i) length_lengths[order[i]] = static_cast<std::uint8_t>(bits.read(3));
  const BasisHuffmanCode length_code(length_lengths);

  std::vector<std::uint8_t> lengths;
  lengths.reserve(symbol_count);
  while (lengths.size() < symbol_count) {
    const std::uint32_t symbol = length_code.decode(bits);
    std::uint32_t run = 1;
    std::uint8_t length = static_cast<std::uint8_t>(symbol);
    if (symbol == few_zeros || symbol == many_zeros) {
      run = symbol == few_zeros ? 3 + bits.read(3) : 11 + bits.read(7);
      length = 0;
    } else if (symbol >= few_repeats) {
      run = symbol == few_repeats ? 3 + bits.read(2) : 7 + bits.read(7);
      if (lengths.empty() || lengths.back() == 0) throw std::runtime_error("a Huffman code repeats nothing");
      length = lengths.back();
    }
    if (run > symbol_count - lengths.size()) throw std::runtime_error("a Huffman code has too many lengths");
    lengths.insert(lengths.end(), run, length);
  }
  return BasisHuffmanCode(lengths);
}

}  // namespace candil
