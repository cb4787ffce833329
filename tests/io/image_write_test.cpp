#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "io/atomic_file.h"
#include "io/error.h"
#include "io/image_file.h"
#include "tests/support/temporary_folder.h"

namespace candil {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

/// 5 x 3 with a value of its own in every channel, from 0 to about 1 for display, larger for linear formats.
Image gradient(int channels, float scale) {
  Image image(5, 3, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = scale * static_cast<float>(i) / static_cast<float>(image.pixels.size() - 1);
  return image;
}

TextureImage read_display(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  return decode_texture(std::as_bytes(std::span(text)), path.filename(), "test", "");
}

TEST(WriteImage, KnowsItsFormats) {
  for (const char* const name : {"a.exr", "a.hdr", "a.pfm", "A.EXR"}) {
    EXPECT_TRUE(is_writable_image(name)) << name;
    EXPECT_TRUE(is_linear_format(name)) << name;
  }
  for (const char* const name : {"a.png", "a.jpg", "a.JPEG", "a.tif", "a.tiff", "a.ppm"}) {
    EXPECT_TRUE(is_writable_image(name)) << name;
    EXPECT_FALSE(is_linear_format(name)) << name;
  }
  for (const char* const name : {"a.gif", "png", "a", "", "a.png/", ".png", "a.exr.txt"})
    EXPECT_FALSE(is_writable_image(name)) << name;
}

TEST(WriteImage, ExrAndPfmKeepEveryBit) {
  const TemporaryFolder folder;
  Image image = gradient(3, 1000);
  image.pixels[7] = 1e-20f, image.pixels[8] = 3e38f;
  for (const char* const name : {"linear.exr", "linear.pfm"}) {
    write_image(folder / name, image, false, {});
    const Image read = read_environment(folder / name);
    EXPECT_EQ(read.width, 5) << name;
    EXPECT_EQ(read.height, 3) << name;
    EXPECT_EQ(read.pixels, image.pixels) << name;
  }
}

// RGBE shares the exponent of the largest channel and keeps 8 bits of each: half a step is 1/256 of the largest, or
// a whole one in writers that cut.
TEST(WriteImage, HdrKeepsEightBitsOfThePeak) {
  const TemporaryFolder folder;
  const Image image = gradient(3, 1000);
  write_image(folder / "linear.hdr", image, false, {});
  const Image read = read_environment(folder / "linear.hdr");
  ASSERT_EQ(read.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < read.pixels.size(); ++i) {
    const float peak = *std::max_element(&image.pixels[i / 3 * 3], &image.pixels[i / 3 * 3] + 3);
    EXPECT_NEAR(read.pixels[i], image.pixels[i], peak / 128) << i;
  }
}

// 0.5 is level 127.5, which rounds up; what is outside of [0, 1] is cut and NaN is black.
TEST(WriteImage, PngRoundsToTheNearestLevel) {
  const TemporaryFolder folder;
  Image image(2, 1, 4);
  image.pixels = {0.5f, 0.2f, -3.0f, 0.25f, 7.0f, std::nanf(""), 1.0f, 0.0f};
  write_image(folder / "a.png", image, true, {});
  const TextureImage read = read_display(folder / "a.png");
  EXPECT_TRUE(read.has_alpha);
  EXPECT_EQ(read.rgba8, (std::vector<glm::u8vec4>{{128, 51, 0, 64}, {255, 0, 255, 0}}));
}

TEST(WriteImage, LeavesAlphaOutUnlessAskedFor) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", gradient(4, 1), false, {});
  EXPECT_FALSE(read_display(folder / "a.png").has_alpha);
  write_image(folder / "a.jpg", gradient(4, 1), true, {});
  EXPECT_FALSE(read_display(folder / "a.jpg").has_alpha);
}

TEST(WriteImage, JpegIsCloseAtFullColorResolution) {
  const TemporaryFolder folder;
  Image image(16, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) image.pixel(x, y)[x < 8 ? 0 : 2] = 0.6f;  // red beside blue
  write_image(folder / "a.jpg", image, false, {});
  const TextureImage read = read_display(folder / "a.jpg");
  ASSERT_EQ(read.rgba8.size(), 256u);
  // 0.6 is level 153. Halved colour resolution would mix the two at the edge, tens of levels off.
  EXPECT_NEAR(read.rgba8[7].x, 153, 12);
  EXPECT_NEAR(read.rgba8[8].z, 153, 12);
  EXPECT_NEAR(read.rgba8[8].x, 0, 12);
}

TEST(WriteImage, PpmIsPlain) {
  const TemporaryFolder folder;
  Image image(2, 1, 3);
  image.pixels = {1, 0, 0.2f, 0, 1, 1};
  write_image(folder / "a.ppm", image, false, {});
  EXPECT_EQ(read_text(folder / "a.ppm"), std::string("P6\n2 1\n255\n\xff\0\x33\0\xff\xff", 17));
}

// PFM stores rows from bottom to top.
TEST(WriteImage, PfmStartsAtTheBottom) {
  const TemporaryFolder folder;
  Image image(1, 2, 3);
  image.pixels = {1, 1, 1, 2, 2, 2};
  write_image(folder / "a.pfm", image, false, {});
  const std::string text = read_text(folder / "a.pfm");
  EXPECT_EQ(text.substr(0, 12), "PF\n1 2\n-1.0\n");
  float first = 0;
  ASSERT_EQ(text.size(), 12u + 24u);
  std::memcpy(&first, &text[12], sizeof(first));
  EXPECT_EQ(first, 2.0f);
}

TEST(WriteImage, SameImageGivesSameBytes) {
  const TemporaryFolder folder;
  for (const std::string extension : {".exr", ".hdr", ".pfm", ".png", ".jpg", ".tif", ".ppm"}) {
    write_image(folder / ("a" + extension), gradient(4, 1), true, {{"candil:seed", "7"}});
    write_image(folder / ("b" + extension), gradient(4, 1), true, {{"candil:seed", "7"}});
    const std::string bytes = read_text(folder / ("a" + extension));
    EXPECT_GT(bytes.size(), 20u) << extension;
    EXPECT_EQ(bytes, read_text(folder / ("b" + extension))) << extension;
  }
}

// The library would stamp EXR and TIFF with the time of day; the constant that stands there instead proves that it
// does not.
TEST(WriteImage, CarriesMetadataAndNoClock) {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", gradient(3, 1), false, {{"candil:scene", "glass of water.glb"}});
  const std::string exr = read_text(folder / "a.exr");
  EXPECT_NE(exr.find("candil:scene"), std::string::npos);
  EXPECT_NE(exr.find("glass of water.glb"), std::string::npos);
  EXPECT_NE(exr.find("1970:01:01 00:00:00"), std::string::npos);
  write_image(folder / "a.tif", gradient(3, 1), false, {});
  EXPECT_NE(read_text(folder / "a.tif").find("1970:01:01 00:00:00"), std::string::npos);
}

TEST(WriteImage, EncodesPngInMemory) {
  const std::vector<std::byte> png = encode_png(gradient(4, 1), true);
  const TextureImage image = decode_texture(png, "memory", "test", "");
  EXPECT_EQ(image.width, 5);
  EXPECT_EQ(image.height, 3);
  EXPECT_TRUE(image.has_alpha);
}

TEST(WriteImage, LeavesNothingBesideTheFile) {
  const TemporaryFolder folder;
  write_text(folder / "a.png", "old");
  write_image(folder / "a.png", gradient(3, 1), false, {});
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
  EXPECT_EQ(read_text(folder / "a.png").substr(1, 3), "PNG");
}

TEST(WriteImage, FailsWithoutTouchingAnything) {
  const TemporaryFolder folder;
  write_text(folder / "file", "a file, no folder");
  EXPECT_THROW(write_image(folder / "missing/a.png", gradient(3, 1), false, {}), OutputError);
  EXPECT_THROW(write_image(folder / "file/a.png", gradient(3, 1), false, {}), OutputError);
  EXPECT_THROW(write_image(folder / "a.gif", gradient(3, 1), false, {}), OutputError);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

// The rename fails, after everything is written: a folder cannot be replaced by a file.
TEST(WriteFileAtomically, RemovesItsTemporaryFileWhenTheRenameFails) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "a.png/inside");
  const std::string text = "content";
  EXPECT_THROW(write_file_atomically(folder / "a.png", std::as_bytes(std::span(text))), OutputError);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a.png/inside"));
}

TEST(CheckWritable, TellsBeforehand) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  EXPECT_NO_THROW(check_writable(folder / "new.png"));
  EXPECT_NO_THROW(check_writable(folder / "file"));
  EXPECT_THROW(check_writable(folder / "missing/new.png"), OutputError);
  EXPECT_THROW(check_writable(folder / "file/new.png"), OutputError);
  EXPECT_THROW(check_writable(folder.path()), OutputError);
  EXPECT_THROW(check_writable(folder.path() / ""), OutputError);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace candil
