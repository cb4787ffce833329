#include "io/image_ppm.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace candil {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

std::vector<std::byte> to_bytes(std::string_view text) {
  std::vector<std::byte> bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

std::string header(std::string_view magic, int width, int height, std::uint32_t resolution) {
  return std::string(magic) + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n" +
         std::to_string(resolution) + "\n";
}

/// The digits of an integer or the shortest that give a float back.
template <typename Number>
void append_number(std::string& text, Number number) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof(digits), number).ptr);
}

/// Lines of the three numbers of one pixel.
template <typename Values, typename ToInteger>
void append_pixels(std::string& text, const Values& rgb, const ToInteger& to_integer) {
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    append_number(text, to_integer(rgb[i]));
    text += i % 3 == 2 ? '\n' : ' ';
  }
}

/// Words of a header, with blanks and comments between them.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word, or an empty one at the end. A comment that sets MAX is remembered on the way.
  std::string_view take() {
    skip();
    const std::size_t end = std::min(text_.find_first_of(blanks), text_.size());
    const std::string_view word = text_.substr(0, end);
    text_.remove_prefix(end);
    return word;
  }

  /// What follows the last word, beginning with the blank that ends it.
  std::string_view rest() const { return text_; }
  std::optional<float> maximum() const { return maximum_; }

 private:
  void skip() {
    while (true) {
      text_.remove_prefix(std::min(text_.find_first_not_of(blanks), text_.size()));
      if (!text_.starts_with('#')) return;
      const std::size_t end = std::min(text_.find_first_of("\r\n"), text_.size());
      read_comment(text_.substr(1, end - 1));
      text_.remove_prefix(end);
    }
  }

  void read_comment(std::string_view comment) {
    constexpr std::string_view key = "MAX=";
    comment.remove_prefix(std::min(comment.find_first_not_of(blanks), comment.size()));
    if (!comment.starts_with(key)) return;
    comment.remove_prefix(key.size());
    comment = comment.substr(0, comment.find_last_not_of(blanks) + 1);
    float maximum = 0;
    const auto [end, status] = std::from_chars(comment.data(), comment.data() + comment.size(), maximum);
    if (status != std::errc() || end != comment.data() + comment.size() || !(maximum > 0) || std::isinf(maximum))
      throw std::runtime_error("#MAX= must be a number above 0");
    maximum_ = maximum;
  }

  std::string_view text_;
  std::optional<float> maximum_;
};

std::uint32_t take_integer(Words& words, const char* what) {
  const std::string_view word = words.take();
  std::uint32_t number = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (word.empty() || status != std::errc() || end != word.data() + word.size())
    throw std::runtime_error(std::string("the PPM header is damaged: ") + what + " is not a whole number");
  return number;
}

/// "pixel (3, 5): " for the sample of that number.
std::string place_of(std::size_t sample, int width) {
  const std::size_t pixel = sample / 3, columns = static_cast<std::size_t>(width);
  return "pixel (" + std::to_string(pixel % columns) + ", " + std::to_string(pixel / columns) + "): ";
}

void check_sample(std::uint32_t value, std::uint32_t resolution, std::size_t sample, int width) {
  if (value > resolution)
    throw std::runtime_error(place_of(sample, width) + std::to_string(value) + " is above the maximum of " +
                             std::to_string(resolution));
}

/// P3: `top` is what the stored maximum stands for.
void read_text(Words& words, std::uint32_t resolution, double top, PpmImage& image, std::size_t samples) {
  // A digit and a blank each; the last blank may be absent.
  if (words.rest().size() < 2 * samples) throw std::runtime_error("the PPM is cut short");
  image.values.reserve(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::string_view word = words.take();
    if (word.empty()) throw std::runtime_error(place_of(i, image.width) + "the PPM is cut short");
    std::uint32_t value = 0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size())
      throw std::runtime_error(place_of(i, image.width) + "not a whole number");
    check_sample(value, resolution, i, image.width);
    image.values.push_back(static_cast<float>(static_cast<double>(value) / resolution * top));
  }
}

/// P6: 16-bit samples have their high byte first.
void read_binary(std::string_view data, std::uint32_t resolution, PpmImage& image, std::size_t samples) {
  const std::size_t bytes = resolution > 255 ? 2 : 1;
  if (data.size() < 1 + samples * bytes) throw std::runtime_error("the PPM is cut short");
  data.remove_prefix(1);
  image.values.reserve(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    std::uint32_t value = static_cast<unsigned char>(data[i * bytes]);
    if (bytes == 2) value = value << 8 | static_cast<unsigned char>(data[i * bytes + 1]);
    check_sample(value, resolution, i, image.width);
    image.values.push_back(static_cast<float>(static_cast<double>(value) / resolution));
  }
}

}  // namespace

std::vector<std::byte> encode_ppm(int width, int height, std::span<const std::uint8_t> rgb) {
  std::string encoded = header("P6", width, height, 255);
  encoded.append(reinterpret_cast<const char*>(rgb.data()), rgb.size());
  return to_bytes(encoded);
}

std::vector<std::byte> encode_ascii_ppm(int width, int height, std::span<const std::uint8_t> rgb) {
  std::string text = header("P3", width, height, 255);
  append_pixels(text, rgb, [](std::uint8_t value) { return static_cast<unsigned>(value); });
  return to_bytes(text);
}

std::vector<std::byte> encode_hdr_ppm(int width, int height, std::span<const float> rgb) {
  constexpr std::uint32_t resolution = 1'000'000'000;
  float maximum = 0;
  for (const float value : rgb)
    if (value > maximum && std::isfinite(value)) maximum = value;
  if (maximum == 0) maximum = 1;
  std::string text = "P3\n#MAX=";
  append_number(text, maximum);
  text += header("", width, height, resolution);
  append_pixels(text, rgb, [maximum](float value) {
    const double share = value > 0 ? std::min(static_cast<double>(value) / maximum, 1.0) : 0.0;
    return static_cast<std::uint32_t>(std::lround(share * resolution));
  });
  return to_bytes(text);
}

PpmImage decode_ppm(std::span<const std::byte> encoded, int max_size) {
  Words words({reinterpret_cast<const char*>(encoded.data()), encoded.size()});
  const bool is_text = words.take() == "P3";
  const std::uint32_t width = take_integer(words, "the width"), height = take_integer(words, "the height");
  const std::uint32_t resolution = take_integer(words, "the maximum value");
  const std::uint32_t limit = static_cast<std::uint32_t>(max_size);
  if (width < 1 || height < 1 || width > limit || height > limit)
    throw std::runtime_error("image of " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; the limit is " + std::to_string(max_size) + " x " + std::to_string(max_size));
  PpmImage image{static_cast<int>(width), static_cast<int>(height), is_text && words.maximum(), {}};
  if (resolution < 1 || (resolution > 65535 && !image.is_linear))
    throw std::runtime_error("the maximum value " + std::to_string(resolution) +
                             " is not from 1 to 65535, and no #MAX= says that the PPM is of high dynamic range");
  const std::size_t samples = std::size_t{3} * width * height;
  const double top = image.is_linear ? *words.maximum() : 1.0;
  if (is_text)
    read_text(words, resolution, top, image, samples);
  else
    read_binary(words.rest(), resolution, image, samples);
  return image;
}

}  // namespace candil
