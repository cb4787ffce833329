#include "tests/support/gltf/ktx2_sample.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace candil::test {

std::vector<std::byte> read_test_data(const std::string& name) {
  std::ifstream stream(std::string(CANDIL_TEST_DATA_DIR) + "/" + name, std::ios::binary);
  if (!stream) throw std::runtime_error("no test data " + name);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(stream), {});
  const auto* const first = reinterpret_cast<const std::byte*>(bytes.data());
  return {first, first + bytes.size()};
}

}  // namespace candil::test
