#include "io/ktx2_container.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;
using namespace std::string_view_literals;

constexpr std::string_view identifier = "\xabKTX 20\xbb\r\n\x1a\n"sv;
constexpr std::size_t header_bytes = 80, level_entry_bytes = 24;

std::uint64_t little_endian_64(Bytes bytes, std::size_t offset) {
  return little_endian_32(bytes, offset) | std::uint64_t{little_endian_32(bytes, offset + 4)} << 32;
}

Bytes part(Bytes file, std::uint64_t offset, std::uint64_t length, const char* what) {
  if (offset > file.size() || length > file.size() - offset)
    throw std::runtime_error(std::string(what) + " lies beyond the end of the file");
  return file.subspan(offset, length);
}

/// Section 4.1, "Texture type".
void check_is_flat(Bytes file, std::uint32_t height) {
  const std::uint32_t depth = little_endian_32(file, 28), layers = little_endian_32(file, 32),
                      faces = little_endian_32(file, 36);
  const auto refuse = [](const char* kind) {
    throw std::runtime_error(std::string("a KTX2 texture ") + kind +
                             " is no picture; glTF wants a two-dimensional one");
  };
  if (height == 0) refuse("of one dimension");
  if (depth != 0) refuse("of three dimensions");
  if (layers != 0) refuse("of layers (an array)");
  if (faces == 6) refuse("of six faces (a cube map)");
  if (faces != 1) throw std::runtime_error("a KTX2 texture of " + std::to_string(faces) + " faces");
}

Ktx2Coding coding_of(std::uint32_t model) {
  constexpr std::uint32_t etc1s = 163, uastc = 166;  // KHR_DF_MODEL_...
  if (model == etc1s) return Ktx2Coding::etc1s;
  if (model == uastc) return Ktx2Coding::uastc;
  throw std::runtime_error("KTX2 of colour model " + std::to_string(model) + "; only ETC1S and UASTC are supported");
}

/// By the channel ids of the samples: Khronos Data Format Specification 1.3, tables of ETC1S and UASTC channels.
Ktx2Channels channels_of(Ktx2Coding coding, const std::vector<std::uint32_t>& ids) {
  const auto are = [&](std::initializer_list<std::uint32_t> wanted) { return std::ranges::equal(ids, wanted); };
  constexpr std::uint32_t rgb = 0, red = 3, green = 4, alpha = 15;             // ETC1S, a slice each
  constexpr std::uint32_t uastc_rgba = 3, uastc_red = 4, uastc_red_green = 6;  // UASTC, in one block
  const bool is_etc1s = coding == Ktx2Coding::etc1s;
  if (are({rgb})) return Ktx2Channels::rgb;
  if (is_etc1s ? are({rgb, alpha}) : are({uastc_rgba})) return Ktx2Channels::rgba;
  if (is_etc1s ? are({red}) : are({uastc_red})) return Ktx2Channels::red;
  if (is_etc1s ? are({red, green}) : are({uastc_red_green})) return Ktx2Channels::red_green;
  throw std::runtime_error("KTX2 with channels other than RGB, RGBA, R and RG");
}

/// The basic block of the data format descriptor (Khronos Data Format Specification 1.3, section 5).
void read_descriptor(Bytes descriptor, Ktx2Image& image) {
  constexpr std::size_t total_size_bytes = 4, block_bytes = 24, sample_bytes = 16;
  if (descriptor.size() < total_size_bytes + block_bytes || little_endian_32(descriptor, 4) != 0)
    throw std::runtime_error("KTX2 without a basic data format descriptor");
  const Bytes block = descriptor.subspan(total_size_bytes);
  const std::size_t size = little_endian_32(block, 4) >> 16;
  if (size < block_bytes || size > block.size()) throw std::runtime_error("the KTX2 data format descriptor is damaged");
  image.coding = coding_of(little_endian_32(block, 8) & 0xff);
  std::vector<std::uint32_t> channels;
  for (std::size_t i = block_bytes; i + sample_bytes <= size; i += sample_bytes)
    channels.push_back(little_endian_32(block, i) >> 24 & 0xf);
  image.channels = channels_of(image.coding, channels);
}

/// The pairs that KHR_texture_basisu allows.
Ktx2Compression compression_of(std::uint32_t scheme, Ktx2Coding coding) {
  constexpr std::uint32_t none = 0, basis_lz = 1, zstandard = 2;
  if (coding == Ktx2Coding::etc1s && scheme == basis_lz) return Ktx2Compression::basis_lz;
  if (coding == Ktx2Coding::uastc && scheme == none) return Ktx2Compression::none;
  if (coding == Ktx2Coding::uastc && scheme == zstandard) return Ktx2Compression::zstandard;
  throw std::runtime_error("KTX2 supercompression scheme " + std::to_string(scheme) + " does not go with " +
                           (coding == Ktx2Coding::etc1s ? "ETC1S" : "UASTC"));
}

}  // namespace

std::uint32_t little_endian_32(Bytes bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << 8 * i;
  return value;
}

bool is_ktx2(Bytes encoded) {
  const auto is_same = [](std::byte byte, char c) { return byte == static_cast<std::byte>(c); };
  return encoded.size() >= identifier.size() &&
         std::ranges::equal(encoded.first(identifier.size()), identifier, is_same);
}

Ktx2Image read_ktx2(Bytes encoded) {
  if (!is_ktx2(encoded)) throw std::runtime_error("not a KTX2 file");
  if (encoded.size() < header_bytes + level_entry_bytes) throw std::runtime_error("the KTX2 file is cut short");
  if (const std::uint32_t format = little_endian_32(encoded, 12); format != 0)
    throw std::runtime_error("KTX2 of Vulkan's format " + std::to_string(format) + "; glTF wants Basis Universal");
  Ktx2Image image;
  image.width = little_endian_32(encoded, 20), image.height = little_endian_32(encoded, 24);
  check_is_flat(encoded, image.height);
  constexpr std::uint32_t most_levels = 32;
  image.level_count = std::max(little_endian_32(encoded, 40), 1u);
  if (image.level_count > most_levels) throw std::runtime_error("KTX2 of more than 32 mip levels");
  read_descriptor(part(encoded, little_endian_32(encoded, 48), little_endian_32(encoded, 52), "the descriptor"), image);
  image.compression = compression_of(little_endian_32(encoded, 44), image.coding);
  image.global_data = part(encoded, little_endian_64(encoded, 64), little_endian_64(encoded, 72), "the global data");
  const std::uint64_t offset = little_endian_64(encoded, header_bytes);
  image.level = part(encoded, offset, little_endian_64(encoded, header_bytes + 8), "the largest mip level");
  image.uncompressed_bytes = little_endian_64(encoded, header_bytes + 16);
  return image;
}

}  // namespace candil
