#include <gtest/gtest.h>

#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "io/image_file.h"
#include "tests/io/image_samples.h"
#include "tests/support/gltf/ktx2_sample.h"

namespace candil {
namespace {

using test::from_base64;
using Bytes = std::vector<std::byte>;

TextureImage decode(const Bytes& encoded) { return decode_texture(encoded, "wood.png", "chair.gltf", "images[2]"); }
TextureImage decode(std::string_view base64) { return decode(from_base64(base64)); }

std::string error_of(const Bytes& encoded) {
  try {
    decode(encoded);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

using Rgba = glm::u8vec4;

TEST(DecodeTexture, KeepsUnassociatedColorUnderAlpha) {
  const TextureImage image = decode(test::png_rgba8);
  EXPECT_EQ(image.name, "wood.png");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_TRUE(image.has_alpha);
  EXPECT_TRUE(image.rgba32.empty());
  EXPECT_EQ(image.rgba8, (std::vector<Rgba>{{200, 100, 50, 128}, {10, 20, 30, 0}}));
}

TEST(DecodeTexture, SpreadsGreyOverTheColors) {
  const TextureImage grey = decode(test::png_grey8);
  EXPECT_FALSE(grey.has_alpha);
  EXPECT_EQ(grey.rgba8, (std::vector<Rgba>{{7, 7, 7, 255}, {250, 250, 250, 255}}));
  const TextureImage with_alpha = decode(test::png_grey_alpha8);
  EXPECT_TRUE(with_alpha.has_alpha);
  EXPECT_EQ(with_alpha.rgba8, (std::vector<Rgba>{{200, 200, 200, 64}, {10, 10, 10, 255}}));
}

TEST(DecodeTexture, ExpandsPalettesAndSingleBits) {
  EXPECT_EQ(decode(test::png_palette).rgba8, (std::vector<Rgba>{{250, 128, 4, 255}, {1, 2, 3, 255}}));
  const TextureImage bits = decode(test::png_grey1);
  ASSERT_EQ(bits.rgba8.size(), 8u);
  EXPECT_EQ(bits.rgba8[0], Rgba(255));
  EXPECT_EQ(bits.rgba8[1], Rgba(0, 0, 0, 255));
  EXPECT_EQ(bits.rgba8[2], Rgba(255));
}

TEST(DecodeTexture, Widens16BitsToFloat) {
  const TextureImage image = decode(test::png_rgb16);
  EXPECT_TRUE(image.rgba8.empty());
  ASSERT_EQ(image.rgba32.size(), 1u);
  const Vec4 expected(1.0f, 32768.0f / 65535.0f, 1.0f / 65535.0f, 1.0f);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(image.rgba32[0][i], expected[i], 1e-6f) << "channel " << i;
}

// glTF 2.0, section 3.8.3: colour space information in image files is ignored.
TEST(DecodeTexture, IgnoresGamma) {
  EXPECT_EQ(decode(test::png_with_gamma).rgba8, (std::vector<Rgba>{{128, 64, 32, 255}}));
}

TEST(DecodeTexture, KeepsWebpColorsApartFromAlpha) {
  TextureImage image;
  try {
    image = decode(test::webp_rgba8);
  } catch (const InputError& error) {
    ASSERT_NE(std::string(error.what()).find("cannot read WebP"), std::string::npos) << error.what();
    GTEST_SKIP() << "this OpenImageIO has no WebP";
  }
  ASSERT_EQ(image.rgba8.size(), 2u);
  // One level off: OpenImageIO before 2.5 multiplies by alpha, which is undone with a rounding error of 255 / 127 / 2.
  const Rgba expected(200, 100, 50, 127);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(image.rgba8[0][i], expected[i], 1) << "channel " << i;
  EXPECT_EQ(image.rgba8[1], Rgba(10, 20, 30, 255));
}

TEST(DecodeTexture, ReadsAvif) {
  TextureImage image;
  try {
    image = decode(test::read_test_data("alpha.avif"));
  } catch (const InputError& error) {
    ASSERT_NE(std::string(error.what()).find("cannot read AVIF"), std::string::npos) << error.what();
    GTEST_SKIP() << "this OpenImageIO has no libheif";
  }
  ASSERT_EQ(image.rgba8.size(), 256u);
  EXPECT_TRUE(image.has_alpha);
  // At this quality the coding is off by a few levels, most in blue, which weighs least in what it stores.
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(image.rgba8[16 * y + x][c], test::ktx2_sample_texel(x, y)[c], 10) << x << ", " << y << ", " << c;
}

/// `bytes` of it replaced where `name` is found first, `offset` after its start.
Bytes with_bytes(Bytes file, std::string_view name, std::size_t offset, std::initializer_list<int> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  std::size_t i = text.find(name) + offset;
  for (const int byte : bytes) file.at(i++) = static_cast<std::byte>(byte);
  return file;
}

// The library decodes while it opens a file, so that this has to come before.
TEST(DecodeTexture, ChecksAvifBeforeDecoding) {
  const Bytes whole = test::read_test_data("alpha.avif");
  EXPECT_NE(error_of(with_bytes(whole, "ispe", 8, {0, 0, 0x40, 1})).find("the limit is 16384 x 16384"),
            std::string::npos);
  EXPECT_NE(error_of(with_bytes(whole, "av01", 0, {'h', 'v', 'c', '1'})).find("not coded as AV1"), std::string::npos);
  EXPECT_NE(error_of(with_bytes(whole, "av01", 0, {'g', 'r', 'i', 'd'})).find("several pictures"), std::string::npos);
  EXPECT_NE(error_of(with_bytes(whole, "ispe", 0, {'f', 'r', 'e', 'e'})), "no error");
}

TEST(DecodeTexture, SurvivesCutAndChangedAvif) {
  const Bytes whole = test::read_test_data("alpha.avif");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(i))).find('\n'),
              std::string::npos);
    Bytes damaged = whole;
    damaged[i] ^= std::byte{0x41};
    EXPECT_EQ(error_of(damaged).find('\n'), std::string::npos);
  }
}

TEST(DecodeTexture, NamesFilePlaceAndImageInErrors) {
  EXPECT_EQ(error_of({}), "chair.gltf: images[2]: wood.png: not a PNG, JPEG, WebP, AVIF or KTX2 image");
}

// A decoder for TIFF, PSD or DICOM behind a texture would be an attack surface that glTF never asks for.
TEST(DecodeTexture, RefusesFormatsThatAreNotTextures) {
  const std::string_view tiff("II*\0\x08\0\0\0", 8), exr("\x76\x2f\x31\x01", 4), gif("GIF89a");
  for (const std::string_view magic : {tiff, exr, gif}) {
    Bytes bytes(200);
    std::memcpy(bytes.data(), magic.data(), magic.size());
    EXPECT_NE(error_of(bytes).find("not a PNG, JPEG, WebP, AVIF or KTX2 image"), std::string::npos);
  }
}

TEST(DecodeTexture, ChecksSizesBeforeDecoding) {
  EXPECT_NE(error_of(from_base64(test::png_bomb)).find("16384 x 16384 pixels in only"), std::string::npos);
  EXPECT_NE(error_of(from_base64(test::png_too_wide)).find("the limit is 16384 x 16384"), std::string::npos);
}

TEST(DecodeTexture, RefusesInk) {
  EXPECT_NE(error_of(from_base64(test::jpeg_cmyk)).find("CMYK colours are not supported"), std::string::npos);
}

TEST(DecodeTexture, RefusesJpegWithEndlessScans) {
  Bytes jpeg = {std::byte{0xff}, std::byte{0xd8}};
  for (int i = 0; i < 501; ++i) jpeg.insert(jpeg.end(), {std::byte{0xff}, std::byte{0xda}});
  EXPECT_NE(error_of(jpeg).find("more than 500 JPEG scans"), std::string::npos);
}

/// Where cut off, every image must be refused in one line, and nothing may crash.
void cut_everywhere(const Bytes& whole) {
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::string error = error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
    EXPECT_NE(error, "no error") << "cut at " << length;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(DecodeTexture, RefusesCutPngs) {
  for (const std::string_view sample : {test::png_rgba8, test::png_palette, test::png_rgb16})
    cut_everywhere(from_base64(sample));
}

// The last byte of WebP data may be padding or spare bits: a cut there need not be noticed.
TEST(DecodeTexture, SurvivesCutWebpAndJpeg) {
  for (const std::string_view sample : {test::webp_rgba8, test::jpeg_cmyk}) {
    const Bytes whole = from_base64(sample);
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_EQ(error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))).find('\n'),
                std::string::npos);
  }
}

// OpenImageIO calls what it reads from memory "memory".
TEST(DecodeTexture, NamesNoFileThatThereIsNot) {
  const Bytes whole = from_base64(test::jpeg_cmyk);
  for (const std::size_t length : {std::size_t{4}, whole.size() / 2}) {
    const std::string error = error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length)));
    EXPECT_EQ(error.substr(0, 22), "chair.gltf: images[2]:") << error;
    EXPECT_EQ(error.find("memory"), std::string::npos) << error;
  }
}

// Every chunk of a PNG carries a checksum, so that no changed byte goes unnoticed.
TEST(DecodeTexture, RefusesPngWithAnyByteChanged) {
  const Bytes whole = from_base64(test::png_rgba8);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    Bytes damaged = whole;
    damaged[i] ^= std::byte{0x10};
    EXPECT_NE(error_of(damaged), "no error") << "byte " << i;
  }
}

}  // namespace
}  // namespace candil
