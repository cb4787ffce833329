/// The container of KTX2 textures: KTX File Format Specification 2.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace candil {

enum class Ktx2Coding { etc1s, uastc };
enum class Ktx2Compression { none, basis_lz, zstandard };

/// What the texture's channels are; glTF's KHR_texture_basisu allows no others.
enum class Ktx2Channels { rgb, rgba, red, red_green };

/// The largest picture of a two-dimensional texture, its bytes still in the file.
struct Ktx2Image {
  std::uint32_t width = 0, height = 0;
  Ktx2Coding coding = Ktx2Coding::etc1s;
  Ktx2Compression compression = Ktx2Compression::none;
  Ktx2Channels channels = Ktx2Channels::rgb;
  std::uint32_t level_count = 1;           ///< Pictures in the file: this one and its mip levels.
  std::span<const std::byte> level;        ///< Its bytes, compressed.
  std::uint64_t uncompressed_bytes = 0;    ///< As declared.
  std::span<const std::byte> global_data;  ///< What all levels share (BasisLZ).

  std::uint32_t block_columns() const { return (width + 3) / 4; }
  std::uint32_t block_rows() const { return (height + 3) / 4; }
};

bool is_ktx2(std::span<const std::byte> encoded);

/// Throws std::runtime_error with one line for damaged files, and for those of kinds that textures in glTF do not have.
Ktx2Image read_ktx2(std::span<const std::byte> encoded);

std::uint32_t little_endian_32(std::span<const std::byte> bytes, std::size_t offset);

}  // namespace candil
