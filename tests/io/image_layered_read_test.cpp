/// Reading images layer by layer.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "io/error.h"
#include "io/image_file.h"
#include "tests/io/image_samples.h"
#include "tests/support/temporary_folder.h"

namespace candil::test {
namespace {

std::vector<std::string> everything(const std::vector<std::string>& names) { return names; }

Image filled(int width, int height, int channels, float first) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = first + static_cast<float>(i);
  return image;
}

void write_sample(const TemporaryFolder& folder, std::string_view base64, const std::string& name) {
  const std::vector<std::byte> bytes = from_base64(base64);
  write_text(folder / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// One part of an EXR file: its name, channels, and the values, all channels of a pixel together.
struct Part {
  std::string name;
  std::vector<std::string> channels;
  int width, height;
  std::vector<float> values;
};

void write_parts(const std::filesystem::path& path, const std::vector<Part>& parts) {
  std::vector<OIIO::ImageSpec> specs;
  for (const Part& part : parts) {
    OIIO::ImageSpec spec(part.width, part.height, static_cast<int>(part.channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = part.channels;
    spec.full_width = parts.front().width, spec.full_height = parts.front().height;
    spec.attribute("oiio:subimagename", part.name);
    specs.push_back(spec);
  }
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
  ASSERT_TRUE(output->open(path.string(), static_cast<int>(specs.size()), specs.data())) << output->geterror();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) {
      ASSERT_TRUE(output->open(path.string(), specs[i], OIIO::ImageOutput::AppendSubimage));
    }
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, parts[i].values.data()));
  }
  ASSERT_TRUE(output->close());
}

TEST(ReadLayers, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::vector<ImageLayer> layers = {{"", {"R", "G", "B", "A"}, filled(3, 2, 4, 1)},
                                          {"depth", {"Z"}, filled(3, 2, 1, 100)},
                                          {"normals", {"X", "Y", "Z"}, filled(3, 2, 3, 200)}};
  write_layers(folder / "a.exr", layers, {{"candil:spp", "12"}});
  const LayeredImage read = read_layers(folder / "a.exr", everything);
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  EXPECT_TRUE(read.is_linear);
  EXPECT_FALSE(read.is_8_bit);
  EXPECT_FALSE(read.has_half_floats);
  EXPECT_EQ(read.names, (std::vector<std::string>{"", "depth", "normals"}));
  ASSERT_EQ(read.layers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.layers[i].name, layers[i].name);
    EXPECT_EQ(read.layers[i].channels, layers[i].channels);
    EXPECT_EQ(read.layers[i].image.pixels, layers[i].image.pixels);
  }
  EXPECT_NE(std::ranges::find(read.metadata, std::pair<std::string, std::string>("candil:spp", "12")),
            read.metadata.end());
}

TEST(ReadLayers, ReadsOnlyWhatIsWanted) {
  const TemporaryFolder folder;
  write_layers(folder / "a.exr",
               std::vector<ImageLayer>{{"", {"R", "G", "B"}, filled(2, 1, 3, 1)}, {"depth", {"Z"}, filled(2, 1, 1, 9)}},
               {});
  const LayeredImage read =
      read_layers(folder / "a.exr", [](const auto&) { return std::vector<std::string>{"depth"}; });
  EXPECT_EQ(read.names.size(), 2u);
  ASSERT_EQ(read.layers.size(), 1u);
  EXPECT_EQ(read.layers[0].image.pixels, (std::vector<float>{9, 10}));
}

// Blender and others write depth as a channel Z without a layer; a layer's channels come in any order.
TEST(ReadLayers, PutsChannelsInOrder) {
  const TemporaryFolder folder;
  write_parts(
      folder / "a.exr",
      {{"", {"B", "G", "R", "Z", "light.B", "light.A", "light.G", "light.R"}, 1, 1, {3, 2, 1, 50, 7, 8, 6, 5}}});
  const LayeredImage read = read_layers(folder / "a.exr", everything);
  ASSERT_EQ(read.layers.size(), 3u);
  std::vector<std::string> names = read.names;
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"", "Z", "light"}));
  for (const ImageLayer& layer : read.layers) {
    if (layer.name.empty()) {
      EXPECT_EQ(layer.image.pixels, (std::vector<float>{1, 2, 3}));
    }
    if (layer.name == "Z") {
      EXPECT_EQ(layer.image.pixels, std::vector<float>{50});
    }
    if (layer.name != "light") continue;
    EXPECT_EQ(layer.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(layer.image.pixels, (std::vector<float>{5, 6, 7, 8}));
  }
}

TEST(ReadLayers, SeesTheFurtherPartsOfAFile) {
  const TemporaryFolder folder;
  write_parts(folder / "a.exr", {{"beauty", {"R", "G", "B"}, 2, 1, {1, 2, 3, 1, 2, 3}},
                                 {"depth", {"Z"}, 2, 1, {4, 8}},
                                 {"more", {"albedo.R", "albedo.G", "albedo.B"}, 2, 1, {5, 6, 7, 5, 6, 7}},
                                 {"cropped", {"Y"}, 1, 1, {1}}});
  const LayeredImage read = read_layers(folder / "a.exr", everything);
  EXPECT_EQ(read.names, (std::vector<std::string>{"", "depth", "albedo"}));
  ASSERT_EQ(read.layers.size(), 3u);
  EXPECT_EQ(read.layers[1].image.pixels, (std::vector<float>{4, 8}));
  EXPECT_EQ(read.layers[2].image.pixels, (std::vector<float>{5, 6, 7, 5, 6, 7}));
}

TEST(ReadLayers, GreyIsColourToo) {
  const TemporaryFolder folder;
  write_parts(folder / "a.exr", {{"", {"Y", "A"}, 2, 1, {1, 0.5f, 2, 1}}});
  const LayeredImage read = read_layers(folder / "a.exr", everything);
  ASSERT_EQ(read.layers.size(), 1u);
  EXPECT_EQ(read.layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(read.layers[0].image.pixels, (std::vector<float>{1, 1, 1, 0.5f, 2, 2, 2, 1}));
}

// (200, 100, 50, 128), (10, 20, 30, 0), colours not yet multiplied by alpha.
TEST(ReadLayers, DisplayValuesStayAsStoredButForAlpha) {
  const TemporaryFolder folder;
  write_sample(folder, png_rgba8, "a.png");
  const LayeredImage read = read_layers(folder / "a.png", everything);
  EXPECT_FALSE(read.is_linear);
  EXPECT_TRUE(read.is_8_bit);
  EXPECT_EQ(read.names, std::vector<std::string>{""});
  const std::vector<float>& p = read.layers[0].image.pixels;
  EXPECT_FLOAT_EQ(p[0], 200 / 255.0f * (128 / 255.0f));
  EXPECT_FLOAT_EQ(p[3], 128 / 255.0f);
  EXPECT_EQ(p[4] + p[5] + p[6] + p[7], 0);

  write_sample(folder, png_grey8, "grey.png");
  const LayeredImage grey = read_layers(folder / "grey.png", everything);
  EXPECT_EQ(grey.layers[0].channels.size(), 3u);
  EXPECT_FLOAT_EQ(grey.layers[0].image.pixels[5], 250 / 255.0f);
  write_sample(folder, png_rgb16, "wide.png");
  EXPECT_FALSE(read_layers(folder / "wide.png", everything).is_8_bit);
}

TEST(ReadLayers, RefusesWhatIsBroken) {
  const TemporaryFolder folder;
  write_sample(folder, png_bomb, "bomb.png");
  write_text(folder / "text.exr", "no image");
  write_layers(folder / "a.exr", std::vector<ImageLayer>{{"", {"R", "G", "B"}, filled(64, 64, 3, 1)}}, {});
  const std::string whole = read_text(folder / "a.exr");
  write_text(folder / "short.exr", whole.substr(0, whole.size() / 2));
  write_text(folder / "header.exr", whole.substr(0, 40));
  for (const char* name : {"bomb.png", "text.exr", "short.exr", "header.exr", "missing.exr"})
    EXPECT_THROW(read_layers(folder / name, everything), InputError) << name;
  std::vector<std::string> channels;
  for (int i = 0; i < 17; ++i) channels.push_back("many.c" + std::to_string(i));
  write_parts(folder / "many.exr", {{"", channels, 1, 1, std::vector<float>(17, 1.0f)}});
  EXPECT_THROW(read_layers(folder / "many.exr", everything), InputError);
  EXPECT_EQ(read_layers(folder / "many.exr", [](const auto&) { return std::vector<std::string>(); }).names.size(), 1u);
}

}  // namespace
}  // namespace candil::test
