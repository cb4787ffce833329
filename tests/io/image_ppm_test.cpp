#include "io/image_ppm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>

namespace candil {
namespace {

PpmImage decode(const std::string& text) { return decode_ppm(std::as_bytes(std::span(text)), 100); }

std::string error_of(const std::string& text) {
  try {
    decode(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(DecodePpm, ReadsText) {
  const PpmImage image = decode("P3 2 1 4\n0 1 2\n3 4 0\n");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_FALSE(image.is_linear);
  EXPECT_EQ(image.values, (std::vector<float>{0, 0.25f, 0.5f, 0.75f, 1, 0}));
}

TEST(DecodePpm, ReadsBinaryOfOneAndTwoBytes) {
  EXPECT_EQ(decode(std::string("P6\n1 1\n255\n\xff\0\x33", 14)).values, (std::vector<float>{1, 0, 0.2f}));
  // 0xffff, 0x8000 of 65535 and 1, the high byte first.
  const PpmImage wide = decode(std::string("P6 1 1 65535 \xff\xff\x80\0\0\1", 19));
  EXPECT_EQ(wide.values, (std::vector<float>{1, 32768.0f / 65535, 1.0f / 65535}));
}

// A blank ends the header, even where the first sample looks like one.
TEST(DecodePpm, BinaryDataMayLookLikeBlanksAndComments) {
  EXPECT_EQ(decode("P6 1 1 255\n\n# ").values, (std::vector<float>{10 / 255.0f, 35 / 255.0f, 32 / 255.0f}));
}

// 48 is the maximum: 250 of 1000 is 12, and so on. Comments may stand everywhere.
TEST(DecodePpm, ReadsTheHighDynamicRangeVariant) {
  const PpmImage image = decode("P3\n# made by hand\n#MAX=48.0\n2 # columns\n1\n1000\n250 500 1000\n# row\n0 1 999");
  EXPECT_TRUE(image.is_linear);
  const std::vector<float> expected = {12, 24, 48, 0, 0.048f, 47.952f};
  ASSERT_EQ(image.values.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_FLOAT_EQ(image.values[i], expected[i]) << i;
}

TEST(DecodePpm, ReadsMaximumInEveryWriting) {
  for (const std::string comment : {"#MAX=10000000", "# MAX=1e7", "#MAX=1.0e+7 ", "#MAX=10000000.0\r"})
    EXPECT_EQ(decode("P3\n" + comment + "\n1 1\n4000000000\n4000000000 2000000000 0\n").values,
              (std::vector<float>{1e7f, 5e6f, 0}))
        << comment;
}

// In P6, it is a comment like any other.
TEST(DecodePpm, MaximumIsForTextOnly) {
  const PpmImage image = decode("P6\n#MAX=5\n1 1\n255\n\xff\xff\xff");
  EXPECT_FALSE(image.is_linear);
  EXPECT_EQ(image.values[0], 1.0f);
}

TEST(DecodePpm, NamesWhatIsWrong) {
  EXPECT_NE(error_of("P3").find("the width is not a whole number"), std::string::npos);
  EXPECT_NE(error_of("P3 2 -1 255").find("the height is not"), std::string::npos);
  EXPECT_NE(error_of("P3 2 1 2.5").find("the maximum value is not"), std::string::npos);
  EXPECT_NE(error_of("P3 0 1 255").find("0 x 1"), std::string::npos);
  EXPECT_NE(error_of("P3 101 1 255").find("the limit is 100 x 100"), std::string::npos);
  EXPECT_NE(error_of("P3 99999999999 1 255").find("the width is not"), std::string::npos);
  EXPECT_NE(error_of("P3 1 1 0 0 0 0").find("1 to 65535"), std::string::npos);
  EXPECT_NE(error_of("P3 1 1 65536 0 0 0").find("no #MAX="), std::string::npos);
  EXPECT_NE(error_of("P6 1 1 65536 123456").find("1 to 65535"), std::string::npos);
  EXPECT_NE(error_of("P3 2 1 255 1 2 3 4 5 6e0").find("pixel (1, 0): not a whole number"), std::string::npos);
  EXPECT_NE(error_of("P3 2 1 255 1 2 3 -4 5 6").find("pixel (1, 0): not a whole number"), std::string::npos);
  EXPECT_NE(error_of("P3 1 2 255 1 2 3 4 256 6").find("pixel (0, 1): 256 is above the maximum of 255"),
            std::string::npos);
  EXPECT_NE(error_of("P3 2 1 255 1 22 333 4 5 6").find("pixel (0, 0): 333 is above"), std::string::npos);
  EXPECT_NE(error_of("P3 100 100 255 1 2 3").find("cut short"), std::string::npos);
  EXPECT_NE(error_of("P3 2 1 255 111 111 111 111").find("pixel (1, 0): the PPM is cut short"), std::string::npos);
  EXPECT_NE(error_of("P6 1 1 255 12").find("cut short"), std::string::npos);
  EXPECT_NE(error_of("P6 1 1 300 12345").find("cut short"), std::string::npos);
  EXPECT_NE(error_of("P6 1 1 3 \1\2\4").find("pixel (0, 0): 4 is above the maximum of 3"), std::string::npos);
  for (const char* const maximum : {"0", "-1", "nan", "inf", "1e99", "five", "", "5 6"})
    EXPECT_NE(error_of(std::string("P3\n#MAX=") + maximum + "\n1 1\n9\n1 1 1\n").find("#MAX= must be a number above 0"),
              std::string::npos)
        << maximum;
}

// Random bytes in a good file: an image or an error, and never more values than the header says.
TEST(DecodePpm, SurvivesDamage) {
  std::mt19937 random(7);
  const std::string good[] = {"P3\n#MAX=3.5\n3 2\n99\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18\n",
                              "P6\n#comment\n3 2\n255\n123456789012345678"};
  for (int i = 0; i < 4000; ++i) {
    std::string text = good[i % 2];
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random());
    if (i % 3 == 0) text.resize(random() % text.size());
    try {
      const PpmImage image = decode(text);
      EXPECT_EQ(image.values.size(), std::size_t{3} * image.width * image.height);
      for (const float value : image.values) EXPECT_TRUE(std::isfinite(value) && value >= 0);
    } catch (const std::runtime_error& error) {
      EXPECT_GT(std::string(error.what()).size(), 5u);
    }
  }
}

TEST(EncodePpm, WritesTextLineByLine) {
  const std::vector<std::uint8_t> rgb = {0, 1, 255, 7, 80, 9};
  EXPECT_EQ(text_of(encode_ascii_ppm(2, 1, rgb)), "P3\n2 1\n255\n0 1 255\n7 80 9\n");
  EXPECT_EQ(text_of(encode_ascii_ppm(1, 2, rgb)), "P3\n1 2\n255\n0 1 255\n7 80 9\n");
}

// 1e9 stands for the maximum 8: 2 is a quarter of it.
TEST(EncodePpm, WritesTheHighDynamicRangeVariant) {
  const std::vector<float> rgb = {2, 8, 0, -1, std::nanf(""), std::numeric_limits<float>::infinity()};
  EXPECT_EQ(text_of(encode_hdr_ppm(2, 1, rgb)),
            "P3\n#MAX=8\n2 1\n1000000000\n250000000 1000000000 0\n0 0 1000000000\n");
  EXPECT_EQ(text_of(encode_hdr_ppm(1, 1, std::vector<float>{0, 0, 0})), "P3\n#MAX=1\n1 1\n1000000000\n0 0 0\n");
}

// Half a step is 5e-10 of the maximum; rounding to float adds 6e-8 of the value.
TEST(EncodePpm, HighDynamicRangeComesBack) {
  std::vector<float> rgb;
  for (int i = 0; i < 30; ++i) rgb.push_back(std::pow(10.0f, static_cast<float>(i) / 3 - 3));
  for (const float scale : {1e-30f, 1.0f, 1e7f, 3e31f}) {
    std::vector<float> scaled = rgb;
    for (float& value : scaled) value *= scale;
    const PpmImage image = decode(text_of(encode_hdr_ppm(5, 2, scaled)));
    ASSERT_EQ(image.values.size(), scaled.size());
    for (std::size_t i = 0; i < scaled.size(); ++i)
      EXPECT_NEAR(image.values[i], scaled[i], 6e-10f * scaled.back() + 1e-7f * scaled[i]) << i;
    EXPECT_EQ(image.values.back(), scaled.back());
  }
}

}  // namespace
}  // namespace candil
