#include "apps/check/golden_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fstream>

#include "io/error.h"

namespace candil {
namespace {

constexpr int max_side = 4096;
constexpr int value_bits = 11, variance_bits = 3;

/// To the nearest float of `bits` significant bits, halves to even.
float rounded(float value, int bits) {
  if (!std::isfinite(value)) return value;
  const int dropped = 24 - bits;
  std::uint32_t word = std::bit_cast<std::uint32_t>(value);
  word += (1u << (dropped - 1)) - 1 + ((word >> dropped) & 1);
  return std::bit_cast<float>(word & ~((1u << dropped) - 1));
}

void round_image(Image& image, int bits) {
  std::ranges::transform(image.pixels, image.pixels.begin(), [bits](float v) { return rounded(v, bits); });
}

std::vector<std::string> color_channels(const Image& image) {
  return image.channels == 4 ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"R", "G", "B"};
}

/// 64-bit FNV-1a, fed piece by piece.
class Fingerprint {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) state_ = (state_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
  }
  /// Length first, so that neighbouring pieces do not run together.
  void add_length(std::uint64_t length) {
    for (int i = 0; i < 8; ++i) {
      const char byte = static_cast<char>(length >> (8 * i) & 0xff);
      add(&byte, 1);
    }
  }
  std::string text() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

void add_file(Fingerprint& fingerprint, const std::filesystem::path& path) {
  std::error_code status;
  const std::uintmax_t length = std::filesystem::file_size(path, status);
  std::ifstream stream(path, std::ios::binary);
  if (status || !stream) throw InputError(path.string(), "", "cannot be read");
  fingerprint.add_length(length);
  std::vector<char> buffer(1 << 16);
  while (stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || stream.gcount() > 0)
    fingerprint.add(buffer.data(), static_cast<std::size_t>(stream.gcount()));
}

template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void take_metadata(GoldenImage& golden, const std::string& key, const std::string& value) {
  if (key == "candil:spp") {
    golden.samples = number_of<std::uint32_t>(value).value_or(0);
  } else if (key == "candil:scene_hash") {
    golden.scene_hash = value;
  } else if (key == "candil:settings") {
    golden.settings = value;
  } else if (key == "candil:flip_noise") {
    golden.flip_noise = number_of<double>(value);
    if (golden.flip_noise && !(*golden.flip_noise >= 0 && *golden.flip_noise <= 1)) golden.flip_noise.reset();
  } else if (key.starts_with("candil:")) {
    golden.origin.emplace_back(key, value);
  }
}

}  // namespace

void round_golden(GoldenImage& golden) {
  round_image(golden.mean, value_bits);
  round_image(golden.variance, variance_bits);
  if (golden.display) round_image(*golden.display, value_bits);
}

GoldenImage read_golden(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(path.string(), "", why + "; is it a golden image?");
  };
  const auto choose = [](std::vector<std::string> names) {
    std::erase_if(names,
                  [](const std::string& name) { return !name.empty() && name != "variance" && name != "display"; });
    return names;
  };
  LayeredImage file = read_layers(path, choose);
  if (file.width > max_side || file.height > max_side) refuse("larger than 4096 pixels");
  GoldenImage golden;
  for (ImageLayer& layer : file.layers) {
    if (layer.name.empty()) golden.mean = std::move(layer.image);
    if (layer.name == "variance") golden.variance = std::move(layer.image);
    if (layer.name == "display") golden.display = std::move(layer.image);
  }
  for (const auto& [key, value] : file.metadata) take_metadata(golden, key, value);
  if (golden.mean.channels != 3 && golden.mean.channels != 4) refuse("no picture in it");
  if (golden.variance.channels != 3) refuse("no layer named variance");
  if (golden.display && golden.display->channels < 3) refuse("the layer named display has no colours");
  if (golden.samples == 0) refuse("no number of samples in its header");
  return golden;
}

void write_golden(const std::filesystem::path& path, const GoldenImage& golden) {
  std::vector<ImageLayer> layers = {{"", color_channels(golden.mean), golden.mean},
                                    {"variance", {"R", "G", "B"}, golden.variance}};
  if (golden.display) layers.push_back({"display", color_channels(*golden.display), *golden.display});
  ImageMetadata metadata = golden.origin;
  metadata.emplace_back("candil:spp", std::to_string(golden.samples));
  metadata.emplace_back("candil:scene_hash", golden.scene_hash);
  metadata.emplace_back("candil:settings", golden.settings);
  if (golden.flip_noise) metadata.emplace_back("candil:flip_noise", fmt::format("{:.4f}", *golden.flip_noise));
  std::error_code status;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), status);
  write_layers(path, layers, metadata);
}

std::string hash_files(const std::vector<std::filesystem::path>& files) {
  Fingerprint fingerprint;
  for (const std::filesystem::path& file : files) add_file(fingerprint, file);
  return fingerprint.text();
}

std::string hash_text(const std::string& text) {
  Fingerprint fingerprint;
  fingerprint.add(text.data(), text.size());
  return fingerprint.text();
}

}  // namespace candil
