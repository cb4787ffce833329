#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "io/basis_uastc.h"

namespace candil {
namespace {

using Block = std::array<std::byte, uastc_block_bytes>;

/// A block as a 128-bit number, its first bit the lowest.
struct BlockNumber {
  std::uint64_t low = 0, high = 0;

  void set(unsigned bit, bool value) {
    std::uint64_t& half = bit < 64 ? low : high;
    const std::uint64_t mask = std::uint64_t{1} << bit % 64;
    half = value ? half | mask : half & ~mask;
  }
  void set(unsigned first, unsigned count, std::uint32_t value) {
    for (unsigned i = 0; i < count; ++i) set(first + i, (value >> i & 1) != 0);
  }
  Block bytes() const {
    Block block;
    for (unsigned i = 0; i < 8; ++i) {
      block[i] = static_cast<std::byte>(low >> 8 * i & 0xff);
      block[i + 8] = static_cast<std::byte>(high >> 8 * i & 0xff);
    }
    return block;
  }
};

/// Steele et al., "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014: SplitMix64.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
  }

 private:
  std::uint64_t state_;
};

/// Prefix code of a mode, and where its pattern of subsets is.
struct ModeLayout {
  std::uint32_t code;
  unsigned code_bits, pattern_start, pattern_bits;
  std::uint32_t pattern_count;
  std::uint64_t hash;
};

// FNV-1a hashes of the texels of 1024 random blocks of each mode, all patterns among them. What they should be comes
// from another program: Basis Universal's own transcoder, version 2.50, to RGBA of 8 bits.
TEST(DecodeUastcBlock, AgreesWithTheTranscoderOfTheFormatsAuthors) {
  constexpr std::array<ModeLayout, 19> modes = {{
      {0b0001, 4, 0, 0, 1, 0x3b08c4ffc02e51e7},     {0b110101, 6, 0, 0, 1, 0xf9b648065cdaffc7},
      {0b11101, 5, 20, 5, 30, 0x0ff111725e122d19},  {0b00011, 5, 20, 4, 11, 0x71c03e98280e43ef},
      {0b10011, 5, 20, 5, 30, 0xb59ea0a9469a59a6},  {0b01011, 5, 0, 0, 1, 0x2436fde72083bfa9},
      {0b11011, 5, 0, 0, 1, 0xd9d72af14c0cd741},    {0b00111, 5, 20, 5, 19, 0x293d31894069eaa1},
      {0b10111, 5, 0, 0, 1, 0x2ff9f071cdbe5625},    {0b01111, 5, 28, 5, 30, 0x248d948a0f18e1cb},
      {0b010, 3, 0, 0, 1, 0x0441d997ceadccea},      {0b00, 2, 0, 0, 1, 0x40eda42fee7d564f},
      {0b110, 3, 0, 0, 1, 0x687eaf2574d3b072},      {0b11111, 5, 0, 0, 1, 0x8cc099e43737c193},
      {0b01101, 5, 0, 0, 1, 0x9a16575e22ea9c74},    {0b0000101, 7, 0, 0, 1, 0x2c83cc577a778c42},
      {0b010101, 6, 29, 5, 30, 0xb56063c65a3f8f1e}, {0b100101, 6, 0, 0, 1, 0xbf6acc4bca018992},
      {0b1001, 4, 0, 0, 1, 0xd6e1ff9a44612400},
  }};
  for (std::size_t mode = 0; mode < modes.size(); ++mode) {
    const ModeLayout& layout = modes[mode];
    SplitMix random(mode);
    std::uint64_t hash = 0xcbf29ce484222325;
    for (std::uint32_t i = 0; i < 1024; ++i) {
      BlockNumber number;
      number.low = random.next();
      number.high = random.next();
      number.set(0, layout.code_bits, layout.code);
      number.set(layout.pattern_start, layout.pattern_bits, i % layout.pattern_count);
      const auto texels = decode_uastc_block(number.bytes());
      ASSERT_TRUE(texels) << "mode " << mode;
      for (const glm::u8vec4& texel : *texels)
        for (int c = 0; c < 4; ++c) hash = (hash ^ texel[c]) * 0x100000001b3;
    }
    EXPECT_EQ(hash, layout.hash) << "mode " << mode;
  }
}

// Mode 8: after five bits of mode, the colour of all texels.
TEST(DecodeUastcBlock, OneColor) {
  BlockNumber number;
  number.set(0, 5, 0b10111);
  number.set(5, 8, 12);
  number.set(13, 8, 34);
  number.set(21, 8, 56);
  number.set(29, 8, 78);
  const auto texels = decode_uastc_block(number.bytes());
  ASSERT_TRUE(texels);
  for (const glm::u8vec4& texel : *texels) EXPECT_EQ(texel, glm::u8vec4(12, 34, 56, 78));
}

// Mode 5 begins with 5 bits of mode and 15 of hints; then ends of 8 bits for each channel, then weights of 3 bits, the
// first of 2. Weight i of 7 lies at round(64 i / 7) / 64 of the way.
TEST(DecodeUastcBlock, RunsBetweenTheEndpoints) {
  BlockNumber number;
  number.set(0, 5, 0b01011);
  const std::uint32_t ends[] = {0, 255, 255, 0, 10, 10};
  for (unsigned i = 0; i < 6; ++i) number.set(20 + 8 * i, 8, ends[i]);
  for (unsigned i = 1; i < 16; ++i) number.set(68 + 3 * i - 1, 3, i % 8);  // the first weight, 0, has 2 bits
  const auto texels = decode_uastc_block(number.bytes());
  ASSERT_TRUE(texels);
  for (int i = 0; i < 16; ++i) {
    const int expected = 255 * (i % 8) / 7;
    const glm::u8vec4 texel = (*texels)[static_cast<std::size_t>(i)];
    EXPECT_NEAR(texel.x, expected, 3) << i;  // a weight is off by at most 1/128
    EXPECT_NEAR(texel.y, 255 - expected, 3) << i;
    EXPECT_EQ(texel.z, 10) << i;
    EXPECT_EQ(texel.w, 255) << i;
  }
}

TEST(DecodeUastcBlock, RefusesUnknownModesAndPatterns) {
  BlockNumber number;
  number.set(0, 7, 0b1000101);  // between modes 15 and 17
  EXPECT_FALSE(decode_uastc_block(number.bytes()));
  number.set(0, 5, 0b11101);
  number.set(20, 5, 29);
  EXPECT_TRUE(decode_uastc_block(number.bytes()));
  number.set(20, 5, 30);
  EXPECT_FALSE(decode_uastc_block(number.bytes()));
}

}  // namespace
}  // namespace candil
