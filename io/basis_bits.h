/// Bits of a BasisLZ stream: least significant bit of a byte first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace candil {

/// Reading beyond the end throws std::runtime_error: that alone bounds every loop that reads at least a bit per turn.
class BasisBitReader {
 public:
  explicit BasisBitReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// The next `count` <= 16 bits, zeros beyond the end, without going on.
  std::uint32_t peek(int count) {
    while (available_ < count) {
      if (next_ < bytes_.size()) buffer_ |= std::to_integer<std::uint64_t>(bytes_[next_]) << available_;
      ++next_;
      available_ += 8;
    }
    return static_cast<std::uint32_t>(buffer_ & ((std::uint64_t{1} << count) - 1));
  }

  /// Goes on by `count` bits, which were peeked at.
  void skip(int count) {
    buffer_ >>= count;
    available_ -= count;
    // Whole bytes that were read ahead of the end do not matter before a bit of them is used.
    if (next_ > bytes_.size() && static_cast<std::size_t>(available_) < 8 * (next_ - bytes_.size()))
      throw std::runtime_error("the data end too early");
  }

  std::uint32_t read(int count) {
    const std::uint32_t bits = peek(count);
    skip(count);
    return bits;
  }

  /// A number in groups of `group` bits, lowest first; the bit above each group says whether another follows.
  std::uint32_t read_variable(int group) {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += group) {
      const std::uint32_t bits = read(group + 1);
      value |= (bits & ((1u << group) - 1)) << shift;
      if (bits >> group == 0) return value;
    }
    throw std::runtime_error("a run is too long");
  }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t buffer_ = 0;
  std::size_t next_ = 0;
  int available_ = 0;
};

}  // namespace candil
