#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/color.h"
#include "io/error.h"
#include "io/image_file.h"
#include "tests/io/image_samples.h"
#include "tests/support/temporary_folder.h"

namespace candil {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

std::string error_of(const std::filesystem::path& path) {
  try {
    read_image(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// 3 x 2, with alpha where there are four channels; all of it multiples of 1/255.
Image sample(int channels) {
  Image image(3, 2, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i * 10 % 256) / 255.0f;
  return image;
}

void write_bytes(const std::filesystem::path& path, std::string_view base64) {
  const std::vector<std::byte> bytes = test::from_base64(base64);
  write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

TEST(ReadImage, ReadsBackEveryLinearFormat) {
  const TemporaryFolder folder;
  for (const char* const name : {"a.exr", "a.pfm"}) {
    write_image(folder / name, sample(3), false, {});
    const Image read = read_image(folder / name);
    EXPECT_EQ(read.channels, 3) << name;
    EXPECT_EQ(read.pixels, sample(3).pixels) << name;
  }
  write_image(folder / "a.ppm", sample(3), false, {}, PpmKind::hdr);
  const Image read = read_image(folder / "a.ppm");
  for (std::size_t i = 0; i < read.pixels.size(); ++i) EXPECT_NEAR(read.pixels[i], sample(3).pixels[i], 1e-7f);
}

TEST(ReadImage, MakesDisplayFormatsLinear) {
  const TemporaryFolder folder;
  write_image(folder / "text.ppm", sample(3), false, {}, PpmKind::ascii);
  for (const char* const name : {"a.png", "a.tif", "a.ppm"}) write_image(folder / name, sample(3), false, {});
  for (const char* const name : {"a.png", "a.tif", "a.ppm", "text.ppm"}) {
    const Image read = read_image(folder / name);
    ASSERT_EQ(read.pixels.size(), sample(3).pixels.size()) << name;
    for (std::size_t i = 0; i < read.pixels.size(); ++i)
      EXPECT_NEAR(read.pixels[i], srgb_to_linear(sample(3).pixels[i]), 1e-6f) << name;
  }
}

// EXR stores what it is given; PNG and TIFF store colour that is not premultiplied, so it is multiplied by alpha.
TEST(ReadImage, KeepsAlphaPremultiplied) {
  const TemporaryFolder folder;
  const Image image = sample(4);
  for (const char* const name : {"a.exr", "a.png", "a.tif"}) write_image(folder / name, image, true, {});
  EXPECT_EQ(read_image(folder / "a.exr").pixels, image.pixels);
  for (const char* const name : {"a.png", "a.tif"}) {
    const Image read = read_image(folder / name);
    ASSERT_EQ(read.channels, 4) << name;
    for (std::size_t i = 0; i < read.pixels.size(); ++i) {
      const float alpha = image.pixels[i / 4 * 4 + 3];
      const float expected = i % 4 == 3 ? alpha : alpha * srgb_to_linear(image.pixels[i]);
      EXPECT_NEAR(read.pixels[i], expected, 1e-6f) << name << " " << i;
    }
  }
}

// (200, 64) and (10, 255): grey becomes three channels, its alpha the fourth.
TEST(ReadImage, WidensGrey) {
  const TemporaryFolder folder;
  write_bytes(folder / "grey.png", test::png_grey_alpha8);
  const Image read = read_image(folder / "grey.png");
  ASSERT_EQ(read.channels, 4);
  EXPECT_NEAR(read.pixel(0, 0)[0], srgb_to_linear(200 / 255.0f) * 64 / 255, 1e-6f);
  EXPECT_NEAR(read.pixel(0, 0)[3], 64 / 255.0f, 1e-6f);
  EXPECT_NEAR(read.pixel(1, 0)[2], srgb_to_linear(10 / 255.0f), 1e-6f);
}

TEST(ReadImage, KeepsOddFloats) {
  const TemporaryFolder folder;
  Image image(2, 1, 3);
  image.pixels = {-1, std::numeric_limits<float>::infinity(), 3e38f, std::nanf(""), 0, 1};
  write_image(folder / "odd.exr", image, false, {});
  const Image read = read_image(folder / "odd.exr");
  EXPECT_EQ(read.pixels[0], -1);
  EXPECT_EQ(read.pixels[1], image.pixels[1]);
  EXPECT_TRUE(std::isnan(read.pixels[3]));
}

TEST(ReadImage, NamesFileAndFault) {
  const TemporaryFolder folder;
  write_text(folder / "short.ppm", "P6 2 2 255 123");
  write_text(folder / "text.exr", "not an image");
  EXPECT_NE(error_of(folder / "short.ppm").find("short.ppm: the PPM is cut short"), std::string::npos);
  EXPECT_NE(error_of(folder / "text.exr").find("text.exr: not an HDR, EXR"), std::string::npos);
  EXPECT_NE(error_of(folder / "missing.exr").find("missing.exr: no such file"), std::string::npos);
}

// Whatever byte of a small TIFF is wrong, the library gives pixels or an error of one line.
TEST(ReadImage, SurvivesDamagedTiff) {
  const TemporaryFolder folder;
  write_image(folder / "a.tif", sample(4), true, {});
  const std::string whole = read_text(folder / "a.tif");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0xff);
    write_text(folder / "damaged.tif", damaged);
    EXPECT_EQ(error_of(folder / "damaged.tif").find('\n'), std::string::npos) << i;
    write_text(folder / "cut.tif", whole.substr(0, i));
    EXPECT_NE(error_of(folder / "cut.tif"), "no error") << i;
  }
}

}  // namespace
}  // namespace candil
