/// The header of a PLY file: which elements the file holds, and the layout of their rows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace candil {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
bool is_integer(PlyType type);

/// One value of each row, or a list of values with its length in front.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< Of lists only.

  bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< Rows, as the file claims: not yet compared with its size.
  std::vector<PlyProperty> properties;

  /// Bytes that a binary row has at least: all lists empty.
  std::size_t least_bytes() const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< Bytes; the first row begins here.

  /// Null when there is none.
  const PlyElement* find(std::string_view name) const;
};

/// Lines may end in LF, CR LF or CR. Lines that no keyword begins are ignored with a warning. Throws InputError with
/// the line.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file, std::vector<std::string>& warnings);

}  // namespace candil
