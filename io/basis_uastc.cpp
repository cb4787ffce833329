#include "io/basis_uastc.h"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>

namespace candil {
namespace {

/// Numbers of `bits` bits and, where `base` is 3 or 5, a digit of that base above them (ASTC's integer sequences).
struct Range {
  std::uint32_t base = 0, bits = 0;
};

constexpr Range bits8{0, 8}, bits5{0, 5}, bits4{0, 4};
constexpr Range trits6{3, 6}, trits4{3, 4}, trits2{3, 2}, quints5{5, 5}, quints3{5, 3};

/// How a block of a mode is laid out; see the tables of modes in the specification.
struct Mode {
  std::uint32_t code, code_bits;  ///< Prefix code, lowest bit first.
  std::uint32_t hint_bits;        ///< Advice for transcoding to other formats, skipped.
  std::uint32_t channels;         ///< 2: luminance and alpha, 3: RGB, 4: RGBA; of each endpoint.
  std::uint32_t subsets, planes;  ///< Parts of the block with endpoints of their own; weights of each texel.
  std::uint32_t weight_bits;
  Range endpoints;
};

constexpr std::size_t solid_mode = 8, other_patterns_mode = 7;
constexpr std::array<Mode, 19> modes = {{
    {0b0001, 4, 15, 3, 1, 1, 4, trits6},    // 0
    {0b110101, 6, 15, 3, 1, 1, 2, bits8},   // 1
    {0b11101, 5, 15, 3, 2, 1, 3, bits4},    // 2
    {0b00011, 5, 15, 3, 3, 1, 2, trits2},   // 3
    {0b10011, 5, 15, 3, 2, 1, 2, quints3},  // 4
    {0b01011, 5, 15, 3, 1, 1, 3, bits8},    // 5
    {0b11011, 5, 15, 3, 1, 2, 2, quints5},  // 6
    {0b00111, 5, 15, 3, 2, 1, 2, quints3},  // 7
    {0b10111, 5, 0, 4, 0, 0, 0, bits8},     // 8: one colour
    {0b01111, 5, 23, 4, 2, 1, 2, bits4},    // 9
    {0b010, 3, 17, 4, 1, 1, 4, trits4},     // 10
    {0b00, 2, 17, 4, 1, 2, 2, trits4},      // 11
    {0b110, 3, 17, 4, 1, 1, 3, trits6},     // 12
    {0b11111, 5, 23, 4, 1, 2, 1, bits8},    // 13
    {0b01101, 5, 23, 4, 1, 1, 2, bits8},    // 14
    {0b0000101, 7, 23, 2, 1, 1, 4, bits8},  // 15
    {0b010101, 6, 23, 2, 2, 1, 2, bits8},   // 16
    {0b100101, 6, 23, 2, 1, 2, 2, bits8},   // 17
    {0b1001, 4, 15, 3, 1, 1, 5, bits5},     // 18
}};

constexpr std::uint8_t no_mode = 255;

constexpr std::array<std::uint8_t, 128> make_mode_of_code() {
  std::array<std::uint8_t, 128> table{};
  table.fill(no_mode);
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    for (std::size_t code = modes[mode].code; code < table.size(); code += std::size_t{1} << modes[mode].code_bits)
      table[code] = static_cast<std::uint8_t>(mode);
  }
  return table;
}

/// Which subset a texel belongs to, 2 bits for each, the upper left one lowest. The partitions that ASTC and BC7 have
/// in common, in the specification's order; those of mode 7 are three subsets in BC7.
constexpr std::array<std::uint32_t, 30> patterns_of_2 = {
    0x50505050, 0x40404040, 0x01010101, 0x54505040, 0x05151555, 0x55545450, 0x00010515, 0x01051555,
    0x50400000, 0x00000105, 0x55544000, 0x01155555, 0x00000115, 0x00005555, 0x55555500, 0x00555555,
    0x55551501, 0x40545555, 0x00405054, 0x00004050, 0x15050100, 0x50545555, 0x15050501, 0x00404050,
    0x50545455, 0x14141414, 0x55000055, 0x11111111, 0x00550055, 0x05145041};
constexpr std::array<std::uint32_t, 11> patterns_of_3 = {0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55,
                                                         0x25252525, 0x94949494, 0x58585858, 0x56560202,
                                                         0x92929292, 0x55aa0055, 0xa05050a0};
constexpr std::array<std::uint32_t, 19> patterns_of_mode_7 = {
    0x00005500, 0x10101010, 0x00010505, 0x50504000, 0x55005555, 0x04040404, 0x55555040,
    0x50505054, 0x05500005, 0x00005454, 0x15150000, 0x05000005, 0x00005054, 0x55554000,
    0x14555555, 0x01050505, 0x01015555, 0x01051450, 0x00005455};

/// The bits of a block, lowest bit of the first byte first.
class BlockBits {
 public:
  explicit BlockBits(std::span<const std::byte, uastc_block_bytes> block) {
    for (std::size_t i = 0; i < 8; ++i) {
      low_ |= std::to_integer<std::uint64_t>(block[i]) << 8 * i;
      high_ |= std::to_integer<std::uint64_t>(block[i + 8]) << 8 * i;
    }
  }

  std::uint32_t peek(std::uint32_t count) const { return static_cast<std::uint32_t>(low_ & ((1ull << count) - 1)); }

  /// `count` < 32. A block never needs more than its 128 bits.
  std::uint32_t read(std::uint32_t count) {
    const std::uint32_t bits = peek(count);
    if (count > 0) {
      low_ = low_ >> count | high_ << (64 - count);
      high_ >>= count;
    }
    return bits;
  }

 private:
  std::uint64_t low_ = 0, high_ = 0;
};

/// One number of an endpoint as 8 bits: Khronos Data Format Specification 1.3, section 23.13 (ASTC, "Endpoint
/// Unquantization"). Bits alone are repeated; with a digit above them, B spreads the bits without the lowest one over 9
/// bits, C is the distance of digits.
std::uint8_t unquantized(const Range& range, std::uint32_t digit, std::uint32_t bits) {
  if (range.base == 0) {
    if (range.bits == 8) return static_cast<std::uint8_t>(bits);
    return static_cast<std::uint8_t>(range.bits == 5 ? bits << 3 | bits >> 2 : bits << 4 | bits);
  }
  const std::uint32_t upper = bits >> 1;
  std::uint32_t b = 0, c = 0;
  if (range.base == 3 && range.bits == 2) {
    b = upper * 0b100010110, c = 93;
  } else if (range.base == 3 && range.bits == 4) {
    b = upper << 6 | upper, c = 22;
  } else if (range.base == 3) {
    b = upper << 4 | upper >> 4, c = 5;
  } else if (range.bits == 3) {
    b = upper << 7 | upper << 1 | upper >> 1, c = 26;
  } else {
    b = upper << 5 | upper >> 3, c = 6;
  }
  const std::uint32_t flip = bits & 1 ? 0x1ff : 0;
  const std::uint32_t value = (digit * c + b) ^ flip;
  return static_cast<std::uint8_t>((flip & 0x80) | value >> 2);
}

using Numbers = std::array<std::uint8_t, 18>;

/// All digits come first, several of them as one number of the fewest bits, then all bits.
Numbers read_endpoints(BlockBits& bits, const Range& range, std::uint32_t count) {
  std::array<std::uint32_t, 18> digits{};
  if (range.base != 0) {
    constexpr std::array<std::uint32_t, 6> bits_of_trits = {0, 2, 4, 5, 7, 8}, bits_of_quints = {0, 3, 5, 7, 0, 0};
    const std::uint32_t group = range.base == 3 ? 5 : 3;
    for (std::uint32_t i = 0; i < count; i += group) {
      const std::uint32_t size = std::min(group, count - i);
      std::uint32_t number = bits.read(range.base == 3 ? bits_of_trits[size] : bits_of_quints[size]);
      for (std::uint32_t k = 0; k < size; ++k, number /= range.base) digits[i + k] = number % range.base;
    }
  }
  Numbers numbers{};
  for (std::uint32_t i = 0; i < count; ++i) numbers[i] = unquantized(range, digits[i], bits.read(range.bits));
  return numbers;
}

/// A weight as a number from 0 to 64 (the same section, "Weight Unquantization"): bits repeated to 6, then one more
/// from the middle on.
std::uint32_t weight_of(std::uint32_t bits, std::uint32_t count) {
  constexpr std::array<std::uint32_t, 6> ones = {0, 0b111111, 0b010101, 0b001001, 0, 0};
  std::uint32_t six = bits * ones[count];
  if (count == 4) six = bits << 2 | bits >> 2;
  if (count == 5) six = bits << 1 | bits >> 4;
  return six > 32 ? six + 1 : six;
}

std::uint8_t between(std::uint32_t low, std::uint32_t high, std::uint32_t weight) {
  // Both as 16 bits, 257 times the value; what is left is rounded down.
  return static_cast<std::uint8_t>((257 * (low * (64 - weight) + high * weight) + 32) >> 6 >> 8);
}

/// The two endpoints of each subset. The numbers stand channel by channel, both ends of each.
std::array<std::array<glm::u8vec4, 2>, 3> endpoints_of(const Mode& mode, const Numbers& numbers) {
  std::array<std::array<glm::u8vec4, 2>, 3> endpoints{};
  for (std::size_t subset = 0; subset < mode.subsets; ++subset) {
    for (std::size_t end = 0; end < 2; ++end) {
      const std::uint8_t* const n = &numbers[2 * mode.channels * subset + end];
      glm::u8vec4& color = endpoints[subset][end];
      if (mode.channels == 2) color = {n[0], n[0], n[0], n[2]};
      if (mode.channels == 3) color = {n[0], n[2], n[4], 255};
      if (mode.channels == 4) color = {n[0], n[2], n[4], n[6]};
    }
  }
  return endpoints;
}

/// The pattern of subsets that the block names, all zero where the mode has but one.
std::optional<std::uint32_t> read_pattern(BlockBits& bits, std::size_t mode) {
  const auto at = [](const auto& patterns, std::uint32_t i) {
    return i < patterns.size() ? std::optional(patterns[i]) : std::nullopt;
  };
  if (mode == other_patterns_mode) return at(patterns_of_mode_7, bits.read(5));
  if (modes[mode].subsets == 2) return at(patterns_of_2, bits.read(5));
  if (modes[mode].subsets == 3) return at(patterns_of_3, bits.read(4));
  return 0;
}

}  // namespace

std::optional<std::array<glm::u8vec4, 16>> decode_uastc_block(std::span<const std::byte, uastc_block_bytes> block) {
  static constexpr std::array<std::uint8_t, 128> mode_of_code = make_mode_of_code();
  BlockBits bits(block);
  const std::size_t mode_index = mode_of_code[bits.peek(7)];
  if (mode_index == no_mode) return {};
  const Mode& mode = modes[mode_index];
  bits.read(mode.code_bits);
  std::array<glm::u8vec4, 16> texels;
  if (mode_index == solid_mode) {
    glm::u8vec4 color;
    for (int i = 0; i < 4; ++i) color[i] = static_cast<std::uint8_t>(bits.read(8));
    texels.fill(color);
    return texels;
  }
  bits.read(mode.hint_bits);
  // With two weights a texel, the second is that of one channel alone.
  std::uint32_t second_channel = 4;
  if (mode.planes == 2) second_channel = mode.channels == 2 ? 3 : bits.read(2);
  const std::optional<std::uint32_t> pattern = read_pattern(bits, mode_index);
  if (!pattern) return {};
  const auto endpoints = endpoints_of(mode, read_endpoints(bits, mode.endpoints, 2 * mode.channels * mode.subsets));

  std::array<bool, 3> has_begun{};
  for (std::uint32_t i = 0; i < 16; ++i) {
    const std::uint32_t subset = *pattern >> 2 * i & 3;
    // The highest bit of the first weight of each subset is 0 and not stored.
    const std::uint32_t stored = mode.weight_bits - (has_begun[subset] ? 0 : 1);
    has_begun[subset] = true;
    const std::uint32_t first = weight_of(bits.read(stored), mode.weight_bits);
    const std::uint32_t second = mode.planes == 2 ? weight_of(bits.read(stored), mode.weight_bits) : first;
    const auto& [low, high] = endpoints[subset];
    for (std::uint32_t channel = 0; channel < 4; ++channel) {
      const int c = static_cast<int>(channel);
      texels[i][c] = between(low[c], high[c], channel == second_channel ? second : first);
    }
  }
  return texels;
}

}  // namespace candil
