#include "io/zstandard.h"

#ifdef CANDIL_HAS_ZSTD
#include <zstd.h>
#endif

#include <stdexcept>
#include <string>

namespace candil {

#ifdef CANDIL_HAS_ZSTD

std::vector<std::byte> decompress_zstandard(std::span<const std::byte> compressed, std::size_t size) {
  std::vector<std::byte> bytes(size);
  const std::size_t result = ZSTD_decompress(bytes.data(), size, compressed.data(), compressed.size());
  if (ZSTD_isError(result)) throw std::runtime_error(std::string("Zstandard: ") + ZSTD_getErrorName(result));
  if (result != size)
    throw std::runtime_error("Zstandard: " + std::to_string(result) + " bytes instead of " + std::to_string(size));
  return bytes;
}

#else

std::vector<std::byte> decompress_zstandard(std::span<const std::byte>, std::size_t) {
  throw std::runtime_error("this program was built without Zstandard (Debian and Ubuntu: libzstd-dev)");
}

#endif

}  // namespace candil
