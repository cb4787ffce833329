#include "tests/io/image_samples.h"

namespace candil::test {

std::vector<std::byte> from_base64(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::byte> bytes;
  unsigned value = 0;
  int bits = 0;
  for (const char letter : text) {
    if (letter == '=') break;
    value = value << 6 | static_cast<unsigned>(digits.find(letter));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<std::byte>(value >> bits & 0xff));
  }
  return bytes;
}

}  // namespace candil::test
