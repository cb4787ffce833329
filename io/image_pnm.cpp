#include "io/image_pnm.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace candil {
namespace {

std::vector<std::byte> with_header(const std::string& header, std::size_t content_size) {
  std::vector<std::byte> encoded(header.size() + content_size);
  std::memcpy(encoded.data(), header.data(), header.size());
  return encoded;
}

/// Takes the next word and the one blank after it off the front of `text`.
std::string_view take_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t end = text.find_first_of(blanks);
  // No honest header has longer words; without the limit, a file without blanks would be one word.
  if (end == std::string_view::npos || end > 32) throw std::runtime_error("the PFM header is damaged");
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end + 1);
  return word;
}

template <typename Number>
Number take_number(std::string_view& text) {
  const std::string_view word = take_word(text);
  Number number{};
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (status != std::errc() || end != word.data() + word.size()) throw std::runtime_error("the PFM header is damaged");
  return number;
}

float swap_bytes(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>(bits >> 24 | (bits >> 8 & 0xff00u) | (bits << 8 & 0xff0000u) | bits << 24);
}

}  // namespace

std::vector<std::byte> encode_pfm(int width, int height, std::span<const float> rgb) {
  static_assert(std::endian::native == std::endian::little);
  const std::string header = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  std::vector<std::byte> encoded = with_header(header, rgb.size_bytes());
  const std::size_t row = rgb.size() / static_cast<std::size_t>(height);
  std::byte* to = encoded.data() + header.size();
  for (int y = height - 1; y >= 0; --y, to += row * sizeof(float))
    std::memcpy(to, &rgb[static_cast<std::size_t>(y) * row], row * sizeof(float));
  return encoded;
}

PfmImage decode_pfm(std::span<const std::byte> encoded, int max_size) {
  std::string_view text(reinterpret_cast<const char*>(encoded.data()), encoded.size());
  PfmImage image;
  image.channels = take_word(text) == "PF" ? 3 : 1;
  image.width = take_number<int>(text);
  image.height = take_number<int>(text);
  const float scale = take_number<float>(text);
  if (image.width < 1 || image.height < 1 || image.width > max_size || image.height > max_size)
    throw std::runtime_error("image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                             " pixels; the limit is " + std::to_string(max_size) + " x " + std::to_string(max_size));
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  if (text.size() < row * image.height * sizeof(float)) throw std::runtime_error("the PFM is cut short");
  image.values.resize(row * image.height);
  for (int y = image.height - 1; y >= 0; --y, text.remove_prefix(row * sizeof(float)))
    std::memcpy(&image.values[static_cast<std::size_t>(y) * row], text.data(), row * sizeof(float));
  if (scale > 0)  // the sign tells the byte order: positive is big-endian
    for (float& value : image.values) value = swap_bytes(value);
  return image;
}

}  // namespace candil
