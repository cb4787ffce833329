#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "core/color.h"
#include "io/error.h"
#include "io/image_file.h"
#include "tests/support/temporary_folder.h"

namespace candil {
namespace {

using test::read_text;
using test::TemporaryFolder;
using test::write_text;

std::string error_of(const std::filesystem::path& path) {
  try {
    read_environment(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ReadEnvironment, MakesSrgbFilesLinear) {
  const TemporaryFolder folder;
  Image image(2, 1, 3);
  image.pixels = {0.2f, 0.4f, 1.0f, 0.0f, 0.6f, 0.8f};  // all of them multiples of 1/255
  write_image(folder / "sky.png", image, false, {});
  const Image read = read_environment(folder / "sky.png");
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_NEAR(read.pixels[i], srgb_to_linear(image.pixels[i]), 1e-6f) << i;
}

TEST(ReadEnvironment, LeavesAlphaOut) {
  const TemporaryFolder folder;
  Image image(1, 1, 4);
  image.pixels = {3, 2, 1, 0.5f};
  write_image(folder / "sky.exr", image, true, {});
  EXPECT_EQ(read_environment(folder / "sky.exr").pixels, (std::vector<float>{3, 2, 1}));
}

TEST(ReadEnvironment, CutsNegativeLightAndNamesInfinitePixels) {
  const TemporaryFolder folder;
  Image image(3, 2, 3);
  image.pixel(1, 0)[2] = -1e-4f;
  write_image(folder / "negative.exr", image, false, {});
  EXPECT_EQ(read_environment(folder / "negative.exr").pixel(1, 0)[2], 0.0f);
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    image.pixel(2, 1)[0] = bad;
    write_image(folder / "bad.exr", image, false, {});
    EXPECT_NE(error_of(folder / "bad.exr").find("pixel (2, 1): radiance must be finite"), std::string::npos)
        << error_of(folder / "bad.exr");
  }
}

TEST(ReadEnvironment, ReadsBothByteOrdersAndGreyPfm) {
  const TemporaryFolder folder;
  // 1.0f is 3f 80 00 00, 0.5f is 3f 00 00 00.
  write_text(folder / "big.pfm", std::string("Pf 2 1 1.0\n\x3f\x80\0\0\x3f\0\0\0", 19));
  write_text(folder / "little.pfm", std::string("Pf 2 1 -1.0\n\0\0\x80\x3f\0\0\0\x3f", 20));
  const std::vector<float> expected = {1, 1, 1, 0.5f, 0.5f, 0.5f};
  EXPECT_EQ(read_environment(folder / "big.pfm").pixels, expected);
  EXPECT_EQ(read_environment(folder / "little.pfm").pixels, expected);
}

TEST(ReadEnvironment, RefusesDamagedPfm) {
  const TemporaryFolder folder;
  for (const std::string text :
       {"PF", "PF\n", "PF\n1", "PF 1 1", "PF 1 1 -1\n", "PF 99999 1 -1\n", "PF -1 1 -1\n", "PF 0 5 -1\n", "PF 1 x -1\n",
        "PF 16384 16384 -1\nshort", "PF 4294967297 1 -1\n", "PF 1 1 -1\n12345678901"}) {
    write_text(folder / "a.pfm", text);
    EXPECT_NE(error_of(folder / "a.pfm"), "no error") << text;
  }
}

TEST(ReadEnvironment, NamesWhatIsWrongWithTheFile) {
  const TemporaryFolder folder;
  write_text(folder / "text.hdr", "not an image");
  EXPECT_NE(error_of(folder / "missing.hdr").find("missing.hdr: no such file"), std::string::npos);
  EXPECT_NE(error_of(folder.path()).find("not a regular file"), std::string::npos);
  EXPECT_NE(error_of(folder / "text.hdr").find("text.hdr: not an HDR, EXR"), std::string::npos);
}

TEST(ReadEnvironment, SurvivesCutsAnywhere) {
  const TemporaryFolder folder;
  Image image(4, 4, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
  for (const char* const name : {"a.exr", "a.hdr"}) {
    write_image(folder / name, image, false, {});
    const std::string whole = read_text(folder / name);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      write_text(folder / "cut", whole.substr(0, length));
      const std::string error = error_of(folder / "cut");
      EXPECT_NE(error, "no error") << name << " cut at " << length;
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
}

/// The folder of sample assets, or an empty path.
std::filesystem::path assets() {
  const char* const variable = std::getenv("CANDIL_ASSETS");
  return variable ? variable : CANDIL_ASSETS_DIR;
}

// Files that have crashed versions of the library, or made it ask for all memory. Each has one thing wrong.
TEST(ReadEnvironment, SurvivesHostileFilesOfTheLibraryItself) {
  const std::filesystem::path folder = assets() / "bad/OpenImageIO";
  if (assets().empty() || !std::filesystem::exists(folder)) GTEST_SKIP() << "no sample assets";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string error = error_of(entry.path());
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    // Damaged Exif data is no reason to refuse the pixels.
    const bool is_usable = entry.path().filename() == "corrupt-exif.jpg";
    EXPECT_EQ(error == "no error", is_usable) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace candil
