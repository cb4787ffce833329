/// Every channel of an EXR file by its name, read without io/. Only for tests that link OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace candil::test {

struct ExrChannels {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> values;  ///< Rows from top to bottom.
  std::map<std::string, std::string> texts;          ///< The header's attributes that are text.
  bool has_only_floats = true;

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const auto& [name, pixels] : values) list.push_back(name);
    return list;
  }
};

inline ExrChannels read_exr_channels(const std::filesystem::path& path) {
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string());
  if (!input) throw std::runtime_error(path.string() + ": " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  ExrChannels channels;
  channels.width = spec.width, channels.height = spec.height;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING)
      channels.texts[std::string(attribute.name())] = attribute.get_string();
  for (int c = 0; c < spec.nchannels; ++c) {
    std::vector<float>& pixels = channels.values[spec.channelnames[static_cast<std::size_t>(c)]];
    pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    if (!input->read_image(0, 0, c, c + 1, OIIO::TypeDesc::FLOAT, pixels.data()))
      throw std::runtime_error(path.string() + ": " + input->geterror());
    channels.has_only_floats =
        channels.has_only_floats && spec.channelformat(c) == OIIO::TypeDesc(OIIO::TypeDesc::FLOAT);
  }
  return channels;
}

}  // namespace candil::test
