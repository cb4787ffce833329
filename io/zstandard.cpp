#include "io/zstandard.h"

#include <zstd.h>

#include <stdexcept>
#include <string>

namespace candil {

std::vector<std::byte> decompress_zstandard(std::span<const std::byte> compressed, std::size_t size) {
  std::vector<std::byte> bytes(size);
  const std::size_t result = ZSTD_decompress(bytes.data(), size, compressed.data(), compressed.size());
  if (ZSTD_isError(result)) throw std::runtime_error(std::string("Zstandard: ") + ZSTD_getErrorName(result));
  if (result != size)
    throw std::runtime_error("Zstandard: " + std::to_string(result) + " bytes instead of " + std::to_string(size));
  return bytes;
}

}  // namespace candil
