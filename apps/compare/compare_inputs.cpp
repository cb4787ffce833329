#include "apps/compare/compare_inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <utility>

#include "apps/usage_error.h"
#include "core/color.h"
#include "io/error.h"
#include "io/image_file.h"
#include "metrics/resize.h"

namespace candil {
namespace {

constexpr const char* picture = "picture";
constexpr const char* variance = "variance";

std::string shown_name(const std::string& name) { return name.empty() ? picture : name; }
std::string stored_name(const std::string& name) { return name == picture ? "" : name; }

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

/// The layers that a file is read for: those asked for, else the picture; everything, if there is no picture.
std::vector<std::string> choose_layers(const CompareOptions& options, const std::vector<std::string>& names) {
  if (contains(options.layers, "all")) return names;
  std::vector<std::string> wanted = {""};
  if (!options.layers.empty()) {
    wanted.clear();
    for (const std::string& name : options.layers) wanted.push_back(stored_name(name));
  } else if (!contains(names, "")) {
    return names;
  }
  wanted.emplace_back(variance);
  return wanted;
}

ImageLayer* find_layer(LayeredImage& file, const std::string& name) {
  const auto found = std::ranges::find(file.layers, name, &ImageLayer::name);
  return found == file.layers.end() ? nullptr : &*found;
}

std::string list_layers(const LayeredImage& file) {
  std::vector<std::string> names;
  for (const std::string& name : file.names) names.push_back(shown_name(name));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// The names of the layers to compare; what only one file has is noted.
std::vector<std::string> shared_layers(const CompareOptions& options, const LayeredImage& a, const LayeredImage& b,
                                       std::vector<std::string>& notes) {
  const bool is_named = !options.layers.empty() && !contains(options.layers, "all");
  std::vector<std::string> names;
  if (is_named)
    for (const std::string& name : options.layers) {
      if (!contains(names, stored_name(name))) names.push_back(stored_name(name));
    }
  else if (options.layers.empty() && (contains(a.names, "") || contains(b.names, "")))
    names = {""};
  for (const std::string& name : names)
    for (const auto& [path, file] : {std::pair{&options.a, &a}, {&options.b, &b}})
      if (!contains(file->names, name))
        throw InputError(path->string(), "",
                         fmt::format("no layer '{}'; it has: {}", shown_name(name), list_layers(*file)));
  if (names.empty())
    for (const std::string& name : a.names)
      if (contains(b.names, name) && (name != variance || a.names.size() == 1)) names.push_back(name);
  if (names.empty()) throw InputError(options.b.string(), "", "no layer in common; it has: " + list_layers(b));
  std::vector<std::string> left_out;
  for (const auto* file : {&a, &b})
    for (const std::string& name : file->names)
      if (!contains(names, name) && !contains(left_out, name) && name != variance) left_out.push_back(name);
  for (std::string& name : left_out) name = shown_name(name);
  if (!left_out.empty())
    notes.push_back(fmt::format("not compared: {} (--layer NAME, --layer all)", fmt::join(left_out, ", ")));
  return names;
}

bool is_color(const ImageLayer& layer) {
  return layer.name != variance && layer.channels.size() >= 3 && layer.channels[0] == "R" && layer.channels[1] == "G" &&
         layer.channels[2] == "B" &&
         (layer.channels.size() == 3 || (layer.channels.size() == 4 && layer.channels[3] == "A"));
}

/// The channels of these names, in this order; a missing alpha is 1.
Image take_channels(const ImageLayer& layer, const std::vector<std::string>& channels) {
  Image image(layer.image.width, layer.image.height, static_cast<int>(channels.size()));
  const auto from = layer.channels.size(), to = channels.size();
  for (std::size_t c = 0; c < to; ++c) {
    const auto found = std::ranges::find(layer.channels, channels[c]);
    const auto place = static_cast<std::size_t>(found - layer.channels.begin());
    for (std::size_t i = 0; i < image.pixels.size() / to; ++i)
      image.pixels[i * to + c] = place < from ? layer.image.pixels[i * from + place] : 1.0f;
  }
  return image;
}

/// sRGB values, multiplied by alpha, to linear ones.
void make_linear(Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    const float alpha = channels == 4 ? image.pixels[i + 3] : 1.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      float& value = image.pixels[i + c];
      value = alpha > 0 ? alpha * srgb_to_linear(value / alpha) : srgb_to_linear(value);
    }
  }
}

/// The channels that both layers are compared by.
std::vector<std::string> shared_channels(const CompareOptions& options, const ImageLayer& a, const ImageLayer& b,
                                         std::vector<std::string>& notes) {
  if (a.channels == b.channels) return a.channels;
  const std::string name = shown_name(a.name);
  if (is_color(a) && is_color(b)) {
    notes.push_back(fmt::format("{}: {} has no alpha, it counts as opaque", name, a.channels.size() == 3 ? "A" : "B"));
    return {"R", "G", "B", "A"};
  }
  std::vector<std::string> channels;
  for (const std::string& channel : a.channels)
    if (contains(b.channels, channel)) channels.push_back(channel);
  if (channels.empty())
    throw InputError(
        options.b.string(), name,
        fmt::format("channels {}; those of A are {}", fmt::join(b.channels, ", "), fmt::join(a.channels, ", ")));
  notes.push_back(fmt::format("{}: compared by the channels that both have, {}", name, fmt::join(channels, ", ")));
  return channels;
}

LayerPair make_pair(const CompareOptions& options, LayeredImage& a_file, LayeredImage& b_file, const std::string& name,
                    std::vector<std::string>& notes) {
  ImageLayer &a = *find_layer(a_file, name), &b = *find_layer(b_file, name);
  LayerPair pair;
  pair.name = shown_name(name);
  pair.channels = shared_channels(options, a, b, notes);
  const bool both_are_color = is_color(a) && is_color(b);
  pair.a = a.channels == pair.channels ? std::move(a.image) : take_channels(a, pair.channels);
  pair.b = b.channels == pair.channels ? std::move(b.image) : take_channels(b, pair.channels);
  pair.is_8_bit = a_file.is_8_bit && b_file.is_8_bit;
  if (!both_are_color) {
    pair.kind = ValueKind::data;
  } else if (!a_file.is_linear && !b_file.is_linear) {
    pair.kind = ValueKind::display;
  } else {
    pair.kind = ValueKind::linear;
    if (!a_file.is_linear) make_linear(pair.a);
    if (!b_file.is_linear) make_linear(pair.b);
    if (a_file.is_linear != b_file.is_linear)
      notes.push_back(
          fmt::format("{} is sRGB and the other linear: compared as linear values", a_file.is_linear ? "B" : "A"));
  }
  return pair;
}

std::uint32_t sample_count(const LayeredImage& file) {
  std::uint32_t samples = 0;
  for (const auto& [key, value] : file.metadata)
    if (key == "candil:spp") std::from_chars(value.data(), value.data() + value.size(), samples);
  return samples;
}

std::optional<FileVariance> take_variance(LayeredImage& file) {
  ImageLayer* const layer = find_layer(file, variance);
  if (layer == nullptr || layer->channels != std::vector<std::string>{"R", "G", "B"}) return std::nullopt;
  return FileVariance{layer->image, sample_count(file)};
}

/// Reads both at once. The error of A goes first.
std::pair<LayeredImage, LayeredImage> read_both(const CompareOptions& options) {
  std::pair<LayeredImage, LayeredImage> files;
  std::exception_ptr error_a, error_b;
  const auto read = [&](const std::filesystem::path& path, LayeredImage& file, std::exception_ptr& error) {
    try {
      file = read_layers(path, [&](const std::vector<std::string>& names) { return choose_layers(options, names); });
    } catch (...) {
      error = std::current_exception();
    }
  };
  tbb::parallel_invoke([&] { read(options.a, files.first, error_a); }, [&] { read(options.b, files.second, error_b); });
  for (const std::exception_ptr& error : {error_a, error_b})
    if (error) std::rethrow_exception(error);
  return files;
}

}  // namespace

CompareInputs read_compare_inputs(const CompareOptions& options) {
  auto [a, b] = read_both(options);
  CompareInputs inputs;
  inputs.width = a.width, inputs.height = a.height;
  const bool is_same_size = a.width == b.width && a.height == b.height;
  const std::string sizes =
      fmt::format("{}x{} pixels, but {} has {}x{}", b.width, b.height, options.a.string(), a.width, a.height);
  if (!is_same_size && !options.resizes)
    throw InputError(options.b.string(), "", sizes + "; --align resize compares them all the same");
  const std::vector<std::string> names = shared_layers(options, a, b, inputs.notes);
  if (is_same_size && contains(names, "")) {
    inputs.variance_a = take_variance(a), inputs.variance_b = take_variance(b);
    const bool has_both = inputs.variance_a && inputs.variance_b;
    const bool has_one_sample = has_both && (inputs.variance_a->samples == 1 || inputs.variance_b->samples == 1);
    if (has_one_sample) inputs.notes.emplace_back("no z-test: one sample per pixel tells nothing about the noise");
    if (!has_both || has_one_sample) inputs.variance_a.reset(), inputs.variance_b.reset();
  }
  // Floats of 24 bits that a processor has rounded a few times, or halves of 11 bits.
  inputs.rounding = a.has_half_floats || b.has_half_floats ? 5e-4f : ZTestSettings{}.rounding;
  for (const std::string& name : names) {
    inputs.layers.push_back(make_pair(options, a, b, name, inputs.notes));
    LayerPair& pair = inputs.layers.back();
    if (!is_same_size) pair.b = resize_image(pair.b, a.width, a.height), pair.is_8_bit = false;
  }
  if (!is_same_size) inputs.notes.push_back("B was resized: " + sizes);
  return inputs;
}

PixelSelection select_pixels(const CompareOptions& options, int width, int height) {
  PixelSelection selection(width, height);
  for (const Region& region : options.regions)
    if (region.x + region.width > width || region.y + region.height > height)
      throw UsageError(fmt::format("--region: {},{},{}x{} reaches beyond the image of {}x{} pixels", region.x, region.y,
                                   region.width, region.height, width, height));
  if (!options.regions.empty()) selection.keep(options.regions);
  if (options.mask.empty()) return selection;
  const LayeredImage mask =
      read_layers(options.mask, [](const auto& names) { return std::vector<std::string>{names.front()}; });
  if (mask.width != width || mask.height != height)
    throw InputError(options.mask.string(), "",
                     fmt::format("{}x{} pixels, but the images have {}x{}", mask.width, mask.height, width, height));
  selection.keep(mask.layers.front().image);
  if (selection.count() == 0) throw InputError(options.mask.string(), "", "no pixel is left to compare");
  return selection;
}

}  // namespace candil
