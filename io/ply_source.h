/// The values of a PLY file after its header, one after the other: from text, and from bytes of either order.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "io/ply_header.h"

namespace candil {

/// A value cannot be read; the caller knows element and row.
struct PlyValueError {
  std::string message;
};

[[noreturn]] void fail_at_end();
/// `value` as an integer; throws PlyValueError when it is none.
std::int64_t integer_of(double value);

/// Words between blanks and line ends.
class PlyText {
 public:
  explicit PlyText(std::string_view text) : text_(text) {}

  double number(PlyType type);
  std::int64_t integer(PlyType type);
  template <class Function>
  void for_each_integer(PlyType type, std::uint64_t count, const Function& function) {
    for (std::uint64_t i = 0; i < count; ++i) function(integer(type));
  }
  void skip(PlyType type, std::uint64_t count);
  /// Upper bound of the values of this type that are left.
  std::uint64_t most_values(PlyType) const { return (text_.size() + 1) / 2; }
  /// Upper bound of the rows that are left.
  std::uint64_t most_rows(const PlyElement& element) const;
  bool is_at_end();
  /// Leaves the line: one row is one line or several. True when there was more on it.
  bool end_row();

 private:
  std::string_view next_word();

  std::string_view text_;
};

template <bool is_big_endian>
class PlyBytes {
 public:
  explicit PlyBytes(std::string_view bytes) : bytes_(bytes) {}

  double number(PlyType type) {
    if (type == PlyType::float32) return std::bit_cast<float>(take<std::uint32_t>());
    if (type == PlyType::float64) return std::bit_cast<double>(take<std::uint64_t>());
    return static_cast<double>(integer(type));
  }

  std::int64_t integer(PlyType type) {
    std::int64_t value = 0;
    for_each_integer(type, 1, [&](std::int64_t v) { value = v; });
    return value;
  }

  /// `function` gets `count` values, one by one; the type is looked at once.
  template <class Function>
  void for_each_integer(PlyType type, std::uint64_t count, const Function& function) {
    const auto repeat = [&](auto next) {
      for (std::uint64_t i = 0; i < count; ++i) function(static_cast<std::int64_t>(next()));
    };
    switch (type) {
      case PlyType::int8:
        return repeat([this] { return static_cast<std::int8_t>(take<std::uint8_t>()); });
      case PlyType::uint8:
        return repeat([this] { return take<std::uint8_t>(); });
      case PlyType::int16:
        return repeat([this] { return static_cast<std::int16_t>(take<std::uint16_t>()); });
      case PlyType::uint16:
        return repeat([this] { return take<std::uint16_t>(); });
      case PlyType::int32:
        return repeat([this] { return static_cast<std::int32_t>(take<std::uint32_t>()); });
      case PlyType::uint32:
        return repeat([this] { return take<std::uint32_t>(); });
      default:
        return repeat([this, type] { return integer_of(number(type)); });
    }
  }

  void skip(PlyType type, std::uint64_t count) {
    if (count > most_values(type)) fail_at_end();
    bytes_.remove_prefix(count * size_of(type));
  }

  std::uint64_t most_values(PlyType type) const { return bytes_.size() / size_of(type); }

  std::uint64_t most_rows(const PlyElement& element) const {
    const std::size_t least = element.least_bytes();
    return least == 0 ? std::numeric_limits<std::uint64_t>::max() : bytes_.size() / least;
  }

  bool is_at_end() const { return bytes_.empty(); }
  bool end_row() const { return false; }

 private:
  template <typename Unsigned>
  Unsigned take() {
    constexpr std::size_t size = sizeof(Unsigned);
    if (bytes_.size() < size) fail_at_end();
    Unsigned value = 0;
    for (std::size_t i = 0; i < size; ++i) {  // compilers make one load of it
      const auto byte = static_cast<Unsigned>(static_cast<unsigned char>(bytes_[i]));
      value = static_cast<Unsigned>(value | byte << 8 * (is_big_endian ? size - 1 - i : i));
    }
    bytes_.remove_prefix(size);
    return value;
  }

  std::string_view bytes_;
};

}  // namespace candil
