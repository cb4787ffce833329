#include "io/image_png.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t signature_size = 8;
constexpr std::size_t chunk_overhead = 12;  // length, name, checksum

std::uint32_t big_endian(Bytes bytes) {
  std::uint32_t value = 0;
  for (const std::byte byte : bytes.first(4)) value = value << 8 | std::to_integer<std::uint32_t>(byte);
  return value;
}

using CrcTables = std::array<std::array<std::uint32_t, 256>, 8>;

/// CRC-32 of ISO 3309, as PNG (third edition) section 5.5 wants: of a byte, and of a byte that 1 to 7 zeros follow.
constexpr CrcTables make_crc_tables() {
  CrcTables tables{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = value & 1 ? 0xedb88320u ^ value >> 1 : value >> 1;
    tables[0][i] = value;
  }
  for (std::size_t zeros = 1; zeros < tables.size(); ++zeros) {
    for (std::size_t i = 0; i < 256; ++i) {
      const std::uint32_t shorter = tables[zeros - 1][i];
      tables[zeros][i] = tables[0][shorter & 0xff] ^ shorter >> 8;
    }
  }
  return tables;
}

/// Eight bytes at a time: Kounavis and Berry, "Novel Table Lookup-Based Algorithms for High-Performance CRC
/// Generation", IEEE Transactions on Computers 57, 2008.
std::uint32_t crc32(Bytes bytes) {
  static constexpr CrcTables tables = make_crc_tables();
  const auto at = [&](std::size_t i) { return std::to_integer<std::uint32_t>(bytes[i]); };
  std::uint32_t crc = ~0u;
  for (; bytes.size() >= 8; bytes = bytes.subspan(8)) {
    const std::uint32_t first = crc ^ (at(0) | at(1) << 8 | at(2) << 16 | at(3) << 24);
    crc = tables[7][first & 0xff] ^ tables[6][first >> 8 & 0xff] ^ tables[5][first >> 16 & 0xff] ^
          tables[4][first >> 24] ^ tables[3][at(4)] ^ tables[2][at(5)] ^ tables[1][at(6)] ^ tables[0][at(7)];
  }
  for (const std::byte byte : bytes) crc = tables[0][(crc ^ std::to_integer<std::uint32_t>(byte)) & 0xff] ^ crc >> 8;
  return ~crc;
}

bool makes_pixels(std::string_view name) {
  constexpr std::array<std::string_view, 5> kept = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  return std::ranges::find(kept, name) != kept.end();
}

}  // namespace

std::vector<std::byte> keep_png_pixels(Bytes encoded) {
  std::vector<std::byte> kept;
  kept.reserve(encoded.size());
  kept.assign(encoded.begin(), encoded.begin() + std::min(signature_size, encoded.size()));
  std::size_t offset = signature_size;
  bool has_header = false, has_data = false;
  while (true) {
    if (offset + chunk_overhead > encoded.size()) throw std::runtime_error("the PNG is cut short");
    const Bytes rest = encoded.subspan(offset);
    const std::size_t length = big_endian(rest);
    if (length > rest.size() - chunk_overhead) throw std::runtime_error("the PNG is cut short");
    const std::string_view name(reinterpret_cast<const char*>(rest.data()) + 4, 4);
    const Bytes chunk = rest.first(length + chunk_overhead);
    if (!has_header && name != "IHDR") throw std::runtime_error("the PNG does not begin with its header");
    has_header = true;
    has_data |= name == "IDAT";
    if (makes_pixels(name)) {
      if (crc32(chunk.subspan(4, length + 4)) != big_endian(chunk.last(4)))
        throw std::runtime_error("the PNG is damaged: wrong checksum of a chunk " + std::string(name));
      kept.insert(kept.end(), chunk.begin(), chunk.end());
    }
    if (name == "IEND" && !has_data) throw std::runtime_error("the PNG holds no pixels");
    if (name == "IEND") return kept;
    offset += chunk.size();
  }
}

}  // namespace candil
