#include "io/ktx2_texture.h"

#include <algorithm>
#include <stdexcept>

#include "io/basis_etc1s.h"
#include "io/basis_uastc.h"
#include "io/image_decoder.h"
#include "io/ktx2_container.h"
#include "io/zstandard.h"

namespace candil {
namespace {

using Bytes = std::span<const std::byte>;
using Texel = glm::u8vec4;

/// Calls `set(pixel, texel)` for the texels of a block that lie in the picture: its size need not be a multiple of 4.
template <typename Set>
void for_each_texel(TextureImage& texture, std::uint32_t column, std::uint32_t row, const std::array<Texel, 16>& block,
                    const Set& set) {
  const auto width = static_cast<std::size_t>(texture.width);
  const std::size_t columns = std::min<std::size_t>(4, width - 4 * column);
  const std::size_t rows = std::min<std::size_t>(4, static_cast<std::size_t>(texture.height) - 4 * row);
  for (std::size_t y = 0; y < rows; ++y) {
    Texel* const pixels = &texture.rgba8[(4 * row + y) * width + 4 * column];
    for (std::size_t x = 0; x < columns; ++x) set(pixels[x], block[4 * y + x]);
  }
}

/// Where the first picture's slices are in its level: the second one has alpha, or green.
struct Etc1sSlices {
  Bytes color, second;
};

Bytes slice_of(Bytes level, std::uint32_t offset, std::uint32_t length) {
  if (offset > level.size() || length > level.size() - offset || length == 0)
    throw std::runtime_error("a slice of ETC1S lies beyond its mip level");
  return level.subspan(offset, length);
}

/// "BasisLZ Global Data": a head, a descriptor of each picture (the largest first), then the palettes.
Etc1sPalettes read_global_data(const Ktx2Image& image, Etc1sSlices& slices) {
  constexpr std::size_t head_bytes = 20, descriptor_bytes = 20;
  const std::size_t start = head_bytes + descriptor_bytes * image.level_count;
  const Bytes data = image.global_data;
  if (data.size() < start) throw std::runtime_error("the global data of BasisLZ are cut short");
  Etc1sPalettes palettes;
  palettes.endpoint_count = little_endian_32(data, 0) & 0xffff,
  palettes.selector_count = little_endian_32(data, 0) >> 16;
  const std::uint64_t endpoints = little_endian_32(data, 4), selectors = little_endian_32(data, 8),
                      tables = little_endian_32(data, 12);
  if (endpoints + selectors + tables > data.size() - start)
    throw std::runtime_error("the palettes of ETC1S lie beyond the global data");
  palettes.endpoints = data.subspan(start, endpoints);
  palettes.selectors = data.subspan(start + endpoints, selectors);
  palettes.tables = data.subspan(start + endpoints + selectors, tables);

  constexpr std::uint32_t predicted_frame = 2;  // a frame of a film that needs the one before
  if (little_endian_32(data, head_bytes) & predicted_frame) throw std::runtime_error("KTX2 of a film, not a picture");
  slices.color = slice_of(image.level, little_endian_32(data, head_bytes + 4), little_endian_32(data, head_bytes + 8));
  if (image.channels == Ktx2Channels::rgba || image.channels == Ktx2Channels::red_green)
    slices.second =
        slice_of(image.level, little_endian_32(data, head_bytes + 12), little_endian_32(data, head_bytes + 16));
  return palettes;
}

void decode_etc1s(const Ktx2Image& image, TextureImage& texture) {
  Etc1sSlices slices;
  const Etc1sDecoder decoder(read_global_data(image, slices));
  const auto decode = [&](Bytes slice, const auto& set) {
    decoder.decode(slice, image.block_columns(), image.block_rows(),
                   [&](std::uint32_t column, std::uint32_t row, const std::array<Texel, 16>& block) {
                     for_each_texel(texture, column, row, block, set);
                   });
  };
  decode(slices.color, [](Texel& pixel, Texel texel) { pixel = texel; });
  if (image.channels == Ktx2Channels::rgba) decode(slices.second, [](Texel& pixel, Texel texel) { pixel.w = texel.y; });
  if (image.channels == Ktx2Channels::red_green)
    decode(slices.second, [](Texel& pixel, Texel texel) { pixel.y = texel.y; });
}

void decode_uastc(const Ktx2Image& image, TextureImage& texture) {
  const std::size_t columns = image.block_columns(), rows = image.block_rows();
  const std::size_t size = columns * rows * uastc_block_bytes;
  std::vector<std::byte> decompressed;
  Bytes blocks = image.level;
  if (image.compression == Ktx2Compression::zstandard) {
    if (image.uncompressed_bytes != size) throw std::runtime_error("the KTX2 mip level declares a wrong size");
    blocks = decompressed = decompress_zstandard(blocks, size);
  }
  if (blocks.size() != size)
    throw std::runtime_error("the KTX2 mip level has " + std::to_string(blocks.size()) + " bytes, it needs " +
                             std::to_string(size));
  const bool has_alpha = image.channels == Ktx2Channels::rgba;
  for (std::size_t i = 0; i < columns * rows; ++i) {
    const auto block = decode_uastc_block(blocks.subspan(i * uastc_block_bytes).first<uastc_block_bytes>());
    if (!block) throw std::runtime_error("block " + std::to_string(i) + " of the UASTC data is none");
    for_each_texel(texture, static_cast<std::uint32_t>(i % columns), static_cast<std::uint32_t>(i / columns), *block,
                   [&](Texel& pixel, Texel texel) {
                     pixel = texel;
                     if (!has_alpha) pixel.w = 255;
                   });
  }
}

}  // namespace

TextureImage decode_ktx2(Bytes encoded) {
  const Ktx2Image image = read_ktx2(encoded);
  check_image_size(image.width, image.height, encoded.size());
  TextureImage texture;
  texture.width = static_cast<int>(image.width), texture.height = static_cast<int>(image.height);
  texture.has_alpha = image.channels == Ktx2Channels::rgba;
  texture.rgba8.resize(std::size_t{image.width} * image.height);
  if (image.coding == Ktx2Coding::etc1s) {
    decode_etc1s(image, texture);
  } else {
    decode_uastc(image, texture);
  }
  return texture;
}

}  // namespace candil
