/// The pictures of tests/io/data, and what they show.
#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace candil::test {

std::vector<std::byte> read_test_data(const std::string& name);

/// The texel that was encoded; alpha as in the files that have any.
inline glm::ivec4 ktx2_sample_texel(int x, int y) { return {40 + 12 * x, 30 + 12 * y, 200 - 6 * (x + y), 255 - 7 * x}; }

}  // namespace candil::test
