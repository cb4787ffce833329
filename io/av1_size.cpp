#include "io/av1_size.h"

#include <stdexcept>

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;

[[noreturn]] void fail() { throw std::runtime_error("the AV1 data are damaged"); }

/// Highest bit of a byte first.
class BitReader {
 public:
  explicit BitReader(Bytes bytes) : bytes_(bytes) {}

  std::uint32_t read(int count) {
    std::uint32_t value = 0;
    for (; count > 0; --count, ++position_) {
      if (position_ / 8 >= bytes_.size()) fail();
      value = value << 1 | (std::to_integer<std::uint32_t>(bytes_[position_ / 8]) >> (7 - position_ % 8) & 1);
    }
    return value;
  }

 private:
  Bytes bytes_;
  std::size_t position_ = 0;
};

std::pair<std::uint32_t, std::uint32_t> read_sequence_header(Bytes payload) {
  BitReader bits(payload);
  bits.read(4);  // profile; still picture
  if (bits.read(1) != 0) {
    bits.read(5);  // level, all that a reduced header has
  } else {
    if (bits.read(1) != 0) throw std::runtime_error("AV1 data of a film, not a picture");  // timing information
    const bool has_delay = bits.read(1) != 0;
    const std::uint32_t operating_points = bits.read(5) + 1;
    for (std::uint32_t i = 0; i < operating_points; ++i) {
      bits.read(12);
      if (bits.read(5) > 7) bits.read(1);  // high levels have a tier
      if (has_delay && bits.read(1) != 0) bits.read(4);
    }
  }
  const auto width_bits = static_cast<int>(bits.read(4)) + 1, height_bits = static_cast<int>(bits.read(4)) + 1;
  const std::uint32_t width = bits.read(width_bits) + 1;
  return {width, bits.read(height_bits) + 1};
}

/// Takes a number of 7 bits a byte, lowest first, off the data.
std::size_t take_leb128(Bytes& data) {
  std::size_t value = 0;
  for (int shift = 0; shift < 56; shift += 7) {
    if (data.empty()) fail();
    const auto byte = std::to_integer<std::size_t>(data[0]);
    data = data.subspan(1);
    value |= (byte & 0x7f) << shift;
    if ((byte & 0x80) == 0) return value;
  }
  fail();
}

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> av1_sizes(Bytes data) {
  constexpr std::uint32_t sequence_header = 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes;
  while (!data.empty()) {
    const auto head = std::to_integer<std::uint32_t>(data[0]);
    const bool has_extension = (head & 4) != 0, has_size = (head & 2) != 0;
    const std::size_t head_bytes = has_extension ? 2 : 1;
    if (data.size() < head_bytes) fail();
    data = data.subspan(head_bytes);
    const std::size_t size = has_size ? take_leb128(data) : data.size();
    if (size > data.size()) fail();
    if ((head >> 3 & 15) == sequence_header) sizes.push_back(read_sequence_header(data.first(size)));
    data = data.subspan(size);
  }
  return sizes;
}

}  // namespace candil
