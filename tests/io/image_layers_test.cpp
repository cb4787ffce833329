// EXR files of several layers: names as other programs expect them, every bit kept, and the picture still the picture.
#include <gtest/gtest.h>

#include "io/error.h"
#include "io/image_file.h"
#include "tests/support/exr_channels.h"
#include "tests/support/temporary_folder.h"

namespace candil {
namespace {

using test::ExrChannels;
using test::read_exr_channels;
using test::read_text;
using test::TemporaryFolder;

/// 3 x 2 of values that no half has.
Image ramp(int channels, float start) {
  Image image(3, 2, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = start + 1.0001f * static_cast<float>(i);
  return image;
}

ImageLayer picture(int channels) {
  ImageLayer layer{"", {"R", "G", "B"}, ramp(channels, 0.1f)};
  if (channels == 4) layer.channels.emplace_back("A");
  return layer;
}

std::vector<float> channel_of(const Image& image, int channel) {
  std::vector<float> values;
  for (std::size_t i = channel; i < image.pixels.size(); i += image.channels) values.push_back(image.pixels[i]);
  return values;
}

TEST(WriteLayers, NamesChannelsByLayerAndKeepsEveryBit) {
  const TemporaryFolder folder;
  const std::vector<ImageLayer> layers = {picture(4),
                                          {"normals", {"X", "Y", "Z"}, ramp(3, -7)},
                                          {"depth", {"Z"}, ramp(1, 1e20f)},
                                          {"uv", {"U", "V"}, ramp(2, 0.5f)},
                                          {"object", {"id"}, ramp(1, 16777000)}};
  write_layers(folder / "a.exr", layers, {{"candil:seed", "7"}});
  const ExrChannels read = read_exr_channels(folder / "a.exr");
  EXPECT_EQ(read.names(), (std::vector<std::string>{"A", "B", "G", "R", "depth.Z", "normals.X", "normals.Y",
                                                    "normals.Z", "object.id", "uv.U", "uv.V"}));
  EXPECT_TRUE(read.has_only_floats);
  EXPECT_EQ(read.width, 3);
  EXPECT_EQ(read.height, 2);
  for (const ImageLayer& layer : layers)
    for (int c = 0; c < layer.image.channels; ++c) {
      const std::string& channel = layer.channels[c];
      const std::string name = layer.name.empty() ? channel : layer.name + "." + channel;
      EXPECT_EQ(read.values.at(name), channel_of(layer.image, c)) << name;
    }
  EXPECT_EQ(read.texts.at("candil:seed"), "7");
}

// Also where the layers that follow make four channels, or sort before the picture's own.
TEST(WriteLayers, ReadImageSeesThePicture) {
  const TemporaryFolder folder;
  for (const int channels : {3, 4}) {
    const ImageLayer depth{"depth", {"Z"}, ramp(1, 9)}, albedo{"albedo", {"R", "G", "B"}, ramp(3, 5)};
    const ImageLayer capital{"A", {"R", "G", "B"}, ramp(3, 6)};
    const std::vector<std::vector<ImageLayer>> files = {
        {picture(channels), depth}, {picture(channels), albedo}, {capital, depth, albedo, picture(channels)}};
    for (const std::vector<ImageLayer>& layers : files) {
      write_layers(folder / "a.exr", layers, {});
      const Image read = read_image(folder / "a.exr");
      EXPECT_EQ(read.channels, channels);
      EXPECT_EQ(read.pixels, picture(channels).image.pixels);
    }
  }
}

TEST(WriteLayers, ReadImageOfOneLayer) {
  const TemporaryFolder folder;
  write_layers(folder / "n.exr", std::vector<ImageLayer>{{"normals", {"X", "Y", "Z"}, ramp(3, -2)}}, {});
  EXPECT_EQ(read_image(folder / "n.exr").pixels, ramp(3, -2).pixels);
  write_layers(folder / "d.exr", std::vector<ImageLayer>{{"depth", {"Z"}, ramp(1, 2)}}, {});
  EXPECT_EQ(channel_of(read_image(folder / "d.exr"), 2), ramp(1, 2).pixels);
  // U and V are no grey with alpha.
  write_layers(folder / "u.exr", std::vector<ImageLayer>{{"uv", {"U", "V"}, ramp(2, 0)}}, {});
  EXPECT_THROW(read_image(folder / "u.exr"), InputError);
}

TEST(WriteLayers, SameLayersGiveSameBytes) {
  const TemporaryFolder folder;
  const std::vector<ImageLayer> layers = {picture(3), {"depth", {"Z"}, ramp(1, 0)}};
  write_layers(folder / "a.exr", layers, {});
  write_layers(folder / "b.exr", layers, {});
  EXPECT_EQ(read_text(folder / "a.exr"), read_text(folder / "b.exr"));
}

TEST(WriteLayers, FailsWithoutTouchingAnything) {
  const TemporaryFolder folder;
  const std::vector<ImageLayer> layers = {picture(3)};
  EXPECT_THROW(write_layers(folder / "missing/a.exr", layers, {}), OutputError);
  EXPECT_THROW(write_layers(folder / "a.png", layers, {}), OutputError);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace candil
