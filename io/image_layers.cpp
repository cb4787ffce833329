#include "io/image_layers.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "io/image_input.h"

namespace candil {
namespace {

/// A layer to be: its channels, by their place in one of the file's parts.
struct Group {
  std::string name;
  int part = 0;
  std::vector<int> places;
  std::vector<std::string> channels;  // without the name of the layer
};

/// No picture has more; a hostile header must not make thousands.
constexpr int max_channels = 1024;
constexpr int max_parts = 256;

/// Where a channel belongs among those of its layer; what is not of these sets keeps its place in the file.
int rank_of(std::string_view channel) {
  constexpr std::array<std::string_view, 10> order = {"R", "G", "B", "X", "Y", "Z", "U", "V", "W", "A"};
  const auto* const found = std::ranges::find(order, channel);
  return static_cast<int>(found - order.begin());
}

void sort_channels(Group& group) {
  std::vector<std::size_t> order(group.places.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rank_of(group.channels[i]); });
  Group sorted{group.name, group.part, {}, {}};
  for (const std::size_t i : order) {
    sorted.places.push_back(group.places[i]);
    sorted.channels.push_back(group.channels[i]);
  }
  group = std::move(sorted);
}

bool has_channels(const Group& group, std::initializer_list<std::string_view> channels) {
  return std::ranges::all_of(
      channels, [&](std::string_view name) { return std::ranges::find(group.channels, name) != group.channels.end(); });
}

/// Moves the channels that are not of the picture out of the group without a name: "Z" beside R, G and B is a layer.
void split_picture(std::vector<Group>& groups) {
  const auto picture = std::ranges::find(groups, std::string(), &Group::name);
  if (picture == groups.end()) return;
  const bool is_color = has_channels(*picture, {"R", "G", "B"});
  const bool is_grey = !is_color && has_channels(*picture, {"Y"}) && !has_channels(*picture, {"X"});
  Group kept{"", picture->part, {}, {}};
  std::vector<Group> others;
  for (std::size_t i = 0; i < picture->places.size(); ++i) {
    const std::string& channel = picture->channels[i];
    const bool is_own = (is_color && (channel == "R" || channel == "G" || channel == "B")) ||
                        (is_grey && channel == "Y") || ((is_color || is_grey) && channel == "A");
    if (is_own)
      kept.places.push_back(picture->places[i]), kept.channels.push_back(channel);
    else
      others.push_back({channel, picture->part, {picture->places[i]}, {channel}});
  }
  if (kept.places.empty())
    groups.erase(picture);
  else
    *picture = std::move(kept);
  for (Group& other : others)
    if (std::ranges::find(groups, other.name, &Group::name) == groups.end()) groups.push_back(std::move(other));
}

/// Adds the channels of one part. In all but the first, those without a layer belong to one named after the part.
void add_part(const OIIO::ImageSpec& spec, int part, std::vector<Group>& groups) {
  const std::string part_name = part == 0 ? "" : std::string(spec.get_string_attribute("oiio:subimagename"));
  for (int place = 0; place < spec.nchannels; ++place) {
    const std::string& full = spec.channelnames[static_cast<std::size_t>(place)];
    const std::size_t dot = full.rfind('.');
    std::string layer = dot == std::string::npos ? part_name : full.substr(0, dot);
    if (part > 0 && layer.empty()) layer = "part" + std::to_string(part);
    const std::string channel = dot == std::string::npos ? full : full.substr(dot + 1);
    auto group = std::ranges::find(groups, layer, &Group::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {layer, part, {}, {}});
    if (group->part != part) continue;  // a name that an earlier part has used
    group->places.push_back(place), group->channels.push_back(channel);
  }
}

Image read_group(OIIO::ImageInput& input, const Group& group, int width, int height) {
  const auto [first, last] = std::ranges::minmax(group.places);
  const auto stored = static_cast<std::size_t>(last - first + 1);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<float> values(pixels * stored);
  if (!input.read_image(group.part, 0, first, last + 1, OIIO::TypeDesc::FLOAT, values.data()))
    throw std::runtime_error(first_line(input.geterror()));
  Image image(width, height, 0);
  image.channels = static_cast<int>(group.places.size());
  if (std::ranges::is_sorted(group.places) && stored == group.places.size()) {
    image.pixels = std::move(values);
    return image;
  }
  image.pixels.resize(pixels * group.places.size());
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < group.places.size(); ++c)
      image.pixels[i * group.places.size() + c] =
          values[i * stored + static_cast<std::size_t>(group.places[c] - first)];
  return image;
}

/// Y, or Y and A, as R, G, B, or R, G, B and A.
void spread_grey(ImageLayer& layer) {
  if (!layer.name.empty() || layer.channels.front() == "R") return;
  const bool has_alpha = layer.channels.size() == 2;
  Image color(layer.image.width, layer.image.height, has_alpha ? 4 : 3);
  const auto from = static_cast<std::size_t>(layer.image.channels), to = static_cast<std::size_t>(color.channels);
  for (std::size_t i = 0; i < color.pixels.size() / to; ++i)
    for (std::size_t c = 0; c < to; ++c)
      color.pixels[i * to + c] = layer.image.pixels[i * from + (has_alpha && c == 3 ? std::size_t{1} : 0)];
  layer.image = std::move(color);
  layer.channels = {"R", "G", "B"};
  if (has_alpha) layer.channels.emplace_back("A");
}

ImageMetadata read_texts(const OIIO::ImageSpec& spec) {
  ImageMetadata texts;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs)
    if (attribute.type() == OIIO::TypeDesc::STRING)
      texts.emplace_back(std::string(attribute.name()), attribute.get_string());
  return texts;
}

LayeredImage decode(OIIO::Filesystem::IOProxy& file, const LayerChoice& choose) {
  OIIO::ImageSpec spec;
  const std::unique_ptr<OIIO::ImageInput> input = create_image_input(ImageFormat::exr);
  open_image(*input, file, spec);
  check_size(spec, file.size());
  check_kind(spec);
  LayeredImage result;
  result.width = spec.width, result.height = spec.height, result.is_linear = true;
  result.metadata = read_texts(spec);
  result.has_half_floats = spec.format == OIIO::TypeDesc::HALF;

  std::vector<Group> groups;
  OIIO::ImageSpec part_spec = spec;
  for (int part = 0; part < max_parts && (part == 0 || input->seek_subimage(part, 0, part_spec)); ++part) {
    if (part_spec.nchannels > max_channels) throw std::runtime_error("more than 1024 channels");
    if (part_spec.width != spec.width || part_spec.height != spec.height || part_spec.deep) continue;
    check_kind(part_spec);
    add_part(part_spec, part, groups);
    // What may come after the last part is a complaint of the library that nobody asked for.
  }
  static_cast<void>(input->geterror());
  for (Group& group : groups) sort_channels(group);
  split_picture(groups);
  for (const Group& group : groups) result.names.push_back(group.name);
  const std::vector<std::string> wanted = choose(result.names);
  for (const Group& group : groups) {
    if (std::ranges::find(wanted, group.name) == wanted.end()) continue;
    if (group.places.size() > max_layer_channels)
      throw std::runtime_error("layer '" + group.name + "' has more than 16 channels");
    result.layers.push_back({group.name, group.channels, read_group(*input, group, spec.width, spec.height)});
    spread_grey(result.layers.back());
  }
  input->close();
  static_cast<void>(input->geterror());
  return result;
}

}  // namespace

LayeredImage decode_layers(std::span<const std::byte> encoded, const LayerChoice& choose) {
  OIIO::Filesystem::IOMemReader memory(encoded.data(), encoded.size());
  return decode(memory, choose);
}

LayeredImage decode_layers(const std::filesystem::path& path, const LayerChoice& choose) {
  OIIO::Filesystem::IOFile file(path.string(), OIIO::Filesystem::IOProxy::Read);
  if (file.mode() != OIIO::Filesystem::IOProxy::Read) throw std::runtime_error("cannot be read");
  return decode(file, choose);
}

}  // namespace candil
