#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string_view>

#include "io/ktx2_texture.h"
#include "tests/support/gltf/ktx2_sample.h"

namespace candil::test {
namespace {

using Bytes = std::vector<std::byte>;

#ifdef CANDIL_HAS_ZSTD
constexpr bool has_zstandard = true;
#else
constexpr bool has_zstandard = false;
#endif

std::string error_of(const Bytes& encoded) {
  try {
    decode_ktx2(encoded);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

/// The file with 32 bits of it replaced, little endian.
Bytes with_number(Bytes file, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) file.at(offset + i) = static_cast<std::byte>(value >> 8 * i & 0xff);
  return file;
}

/// Offsets of the header: KTX File Format Specification 2.0, section 3.
constexpr std::size_t vk_format = 12, pixel_width = 20, pixel_height = 24, pixel_depth = 28, layer_count = 32,
                      face_count = 36, level_count = 40, supercompression = 44, level_offset = 80, level_bytes = 88,
                      level_uncompressed = 96;

/// Root mean square of the difference to what was encoded, in levels of 8 bits, the worst of R, G, B and, if the
/// picture has it, A.
double coding_error(const TextureImage& image) {
  double squares[4] = {};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const glm::ivec4 difference = glm::ivec4(image.rgba8.at(16 * y + x)) - ktx2_sample_texel(x, y);
      for (int c = 0; c < (image.has_alpha ? 4 : 3); ++c) squares[c] += difference[c] * difference[c];
    }
  }
  return std::sqrt(std::max(std::max(squares[0], squares[1]), std::max(squares[2], squares[3])) / 256);
}

// The bounds are what the codings can do with this picture, whose channels run in different directions: ETC1S has four
// shades of one colour in each block. Any texel, block or slice out of place, a channel swapped or a row upside down
// makes an error of 12 levels per texel of displacement and more than 30 altogether.
TEST(DecodeKtx2, ShowsWhatWasEncodedWithinTheErrorOfTheCoding) {
  struct Case {
    const char* name;
    bool has_alpha;
    double bound;
  };
  for (const Case& c : {Case{"etc1s.ktx2", false, 20}, Case{"etc1s_alpha.ktx2", true, 20}, Case{"uastc.ktx2", true, 8},
                        Case{"uastc_zstd.ktx2", true, 8}, Case{"uastc_linear.ktx2", false, 8}}) {
    if (!has_zstandard && c.name == std::string_view("uastc_zstd.ktx2")) continue;
    const TextureImage image = decode_ktx2(read_test_data(c.name));
    EXPECT_EQ(image.width, 16) << c.name;
    EXPECT_EQ(image.height, 16) << c.name;
    EXPECT_EQ(image.has_alpha, c.has_alpha) << c.name;
    ASSERT_EQ(image.rgba8.size(), 256u) << c.name;
    EXPECT_LT(coding_error(image), c.bound) << c.name;
    EXPECT_TRUE(c.has_alpha || image.rgba8[0].w == 255) << c.name;
  }
}

#ifndef CANDIL_HAS_ZSTD
TEST(DecodeKtx2, NamesTheMissingPackage) {
  EXPECT_NE(error_of(read_test_data("uastc_zstd.ktx2")).find("libzstd-dev"), std::string::npos);
}
#endif

TEST(DecodeKtx2, ZstandardChangesNothing) {
  if (!has_zstandard) GTEST_SKIP() << "this program was built without libzstd";
  EXPECT_EQ(decode_ktx2(read_test_data("uastc_zstd.ktx2")).rgba8, decode_ktx2(read_test_data("uastc.ktx2")).rgba8);
}

// Alpha is one more picture, in the same palettes.
TEST(DecodeKtx2, AlphaIsASliceOfItsOwn) {
  const TextureImage image = decode_ktx2(read_test_data("etc1s_alpha.ktx2"));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) EXPECT_NEAR(image.rgba8[16 * y + x].w, 255 - 7 * x, 8) << x << ", " << y;
}

// A picture may end within a block: its upper left part stays as it is.
TEST(DecodeKtx2, CutsBlocksAtTheEdge) {
  const TextureImage whole = decode_ktx2(read_test_data("uastc_linear.ktx2"));
  const Bytes file = read_test_data("uastc_linear.ktx2");
  const TextureImage part = decode_ktx2(with_number(with_number(file, pixel_width, 14), pixel_height, 13));
  ASSERT_EQ(part.rgba8.size(), 14u * 13);
  for (int y = 0; y < 13; ++y)
    for (int x = 0; x < 14; ++x) EXPECT_EQ(part.rgba8[14 * y + x], whole.rgba8[16 * y + x]);
}

TEST(DecodeKtx2, RefusesWhatIsNoPicture) {
  const Bytes file = read_test_data("uastc.ktx2");
  const auto error_with = [&](std::size_t offset, std::uint32_t value) {
    return error_of(with_number(file, offset, value));
  };
  EXPECT_NE(error_with(pixel_height, 0).find("of one dimension"), std::string::npos);
  EXPECT_NE(error_with(pixel_depth, 16).find("of three dimensions"), std::string::npos);
  EXPECT_NE(error_with(layer_count, 2).find("an array"), std::string::npos);
  EXPECT_NE(error_with(face_count, 6).find("a cube map"), std::string::npos);
  EXPECT_NE(error_with(vk_format, 37).find("Vulkan's format 37"), std::string::npos);
  EXPECT_NE(error_with(supercompression, 1).find("scheme 1 does not go with UASTC"), std::string::npos);
  EXPECT_NE(error_with(level_count, 33).find("mip levels"), std::string::npos);
}

TEST(DecodeKtx2, ChecksSizesBeforeDecoding) {
  const Bytes file = read_test_data("etc1s.ktx2");
  const auto error_with_size = [&](std::uint32_t width, std::uint32_t height) {
    return error_of(with_number(with_number(file, pixel_width, width), pixel_height, height));
  };
  EXPECT_NE(error_with_size(0, 16).find("without pixels"), std::string::npos);
  EXPECT_NE(error_with_size(16385, 16).find("the limit is 16384 x 16384"), std::string::npos);
  EXPECT_NE(error_with_size(0xffffffff, 0xffffffff).find("the limit is 16384 x 16384"), std::string::npos);
  EXPECT_NE(error_with_size(16384, 16384).find("16384 x 16384 pixels in only"), std::string::npos);
  const Bytes zstandard = read_test_data("uastc_zstd.ktx2");
  EXPECT_NE(error_of(with_number(zstandard, level_uncompressed, 512)).find("declares a wrong size"), std::string::npos);
  EXPECT_NE(error_of(with_number(zstandard, level_uncompressed + 4, 1)).find("declares a wrong size"),
            std::string::npos);
  if (!has_zstandard) return;
  const Bytes larger = with_number(with_number(zstandard, pixel_width, 32), level_uncompressed, 512);
  EXPECT_NE(error_of(larger).find("256 bytes instead of 512"), std::string::npos);
}

TEST(DecodeKtx2, RefusesPartsBeyondTheFile) {
  const Bytes file = read_test_data("uastc.ktx2");
  for (const std::size_t offset : {level_offset, level_offset + 4, level_bytes, level_bytes + 4})
    EXPECT_NE(error_of(with_number(file, offset, 0xffffffff)).find("beyond the end"), std::string::npos) << offset;
}

constexpr const char* samples[] = {"etc1s.ktx2", "etc1s_alpha.ktx2", "uastc.ktx2", "uastc_zstd.ktx2"};

// Smaller mip levels come first in the file, so that no cut leaves the largest whole.
TEST(DecodeKtx2, RefusesCutFiles) {
  for (const char* name : samples) {
    const Bytes whole = read_test_data(name);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const std::string error = error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
      EXPECT_NE(error, "no error") << name << " cut at " << length;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
}

// Damaged files may still mean a picture; what counts is that nothing crashes, hangs or takes much memory.
TEST(DecodeKtx2, SurvivesChangedBytes) {
  std::mt19937 random(1);
  for (const char* name : samples) {
    const Bytes whole = read_test_data(name);
    for (std::size_t i = 0; i < 8 * whole.size() + 2000; ++i) {
      Bytes damaged = whole;
      if (i < 8 * whole.size()) {
        damaged[i / 8] ^= static_cast<std::byte>(1u << i % 8);
      } else {
        for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<std::byte>(random() & 0xff);
      }
      EXPECT_EQ(error_of(damaged).find('\n'), std::string::npos) << name << ", " << i;
    }
  }
}

}  // namespace
}  // namespace candil::test
