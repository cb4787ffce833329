#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/av1_size.h"

namespace candil {
namespace {

using Bytes = std::vector<std::byte>;
using Sizes = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Bits as text, in groups, filled up with zeros to whole bytes.
Bytes from_bits(const std::string& text) {
  Bytes bytes;
  int count = 0;
  for (const char c : text) {
    if (c == ' ') continue;
    if (count++ % 8 == 0) bytes.push_back(std::byte{0});
    if (c == '1') bytes.back() |= static_cast<std::byte>(0x80 >> (count - 1) % 8);
  }
  return bytes;
}

Bytes operator+(const Bytes& a, const Bytes& b) {
  Bytes both(a.size() + b.size());
  std::copy(b.begin(), b.end(), std::copy(a.begin(), a.end(), both.begin()));
  return both;
}

/// A unit (an "OBU") of that type with its size before the payload.
Bytes unit(int type, const Bytes& payload) {
  return Bytes{static_cast<std::byte>(type << 3 | 2), static_cast<std::byte>(payload.size())} + payload;
}

constexpr int sequence = 1, delimiter = 2;

// Profile 0, a still picture with a reduced header, level 0, sizes of 16 bits: 65536 x 65536, the most there can be.
const Bytes largest = from_bits("000 1 1 00000 1111 1111 1111111111111111 1111111111111111");

// A full header: no timing, no display delay, two operating points of which the second is of a high level and has a
// tier; width of 4 bits, height of 3: 16 x 5.
const Bytes full = from_bits("000 1 0 0 0 00001 000000000000 00111 000000000001 01000 1 0011 0010 1111 100");

TEST(Av1Sizes, ReadsEveryHeader) {
  EXPECT_EQ(av1_sizes(unit(sequence, full)), (Sizes{{16, 5}}));
  EXPECT_EQ(av1_sizes(unit(delimiter, {}) + unit(sequence, full) + unit(sequence, largest)),
            (Sizes{{16, 5}, {65536, 65536}}));
  EXPECT_TRUE(av1_sizes(unit(delimiter, {})).empty());
}

TEST(Av1Sizes, TheLastUnitMayGoWithoutItsSize) {
  EXPECT_EQ(av1_sizes(Bytes{static_cast<std::byte>(sequence << 3)} + full), (Sizes{{16, 5}}));
}

TEST(Av1Sizes, RefusesWhatIsCut) {
  const Bytes whole = unit(sequence, largest);
  for (std::size_t length = 1; length < whole.size(); ++length)
    EXPECT_THROW(av1_sizes(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))),
                 std::runtime_error);
  Bytes endless(20, std::byte{0xff});
  endless[0] = static_cast<std::byte>(sequence << 3 | 2);
  EXPECT_THROW(av1_sizes(endless), std::runtime_error);
}

}  // namespace
}  // namespace candil
