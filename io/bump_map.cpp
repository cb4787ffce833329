#include "io/bump_map.h"

#include <algorithm>

namespace candil {
namespace {

float stored_red(const TextureImage& image, int x, int y) {
  const std::size_t i = static_cast<std::size_t>(y) * image.width + x;
  return image.rgba8.empty() ? image.rgba32[i].x : static_cast<float>(image.rgba8[i].x) / 255;
}

/// Bilinear lookups of a mirrored texture meet the border texel again, hence as for clamp.
int neighbour(int i, int size, Wrap wrap) {
  return wrap == Wrap::repeat ? (i + size) % size : std::clamp(i, 0, size - 1);
}

}  // namespace

TextureImage normal_map_from_heights(const TextureImage& heights, float height, Wrap wrap) {
  TextureImage normals;
  normals.name = heights.name;
  normals.width = heights.width, normals.height = heights.height;
  normals.rgba32.reserve(static_cast<std::size_t>(heights.width) * heights.height);
  // Two pixels are 2 / width apart.
  const float slope = 0.5f * height * static_cast<float>(heights.width);
  for (int y = 0; y < heights.height; ++y) {
    const int above = neighbour(y - 1, heights.height, wrap), below = neighbour(y + 1, heights.height, wrap);
    for (int x = 0; x < heights.width; ++x) {
      const int left = neighbour(x - 1, heights.width, wrap), right = neighbour(x + 1, heights.width, wrap);
      const float along_x = slope * (stored_red(heights, right, y) - stored_red(heights, left, y));
      const float along_y = slope * (stored_red(heights, x, above) - stored_red(heights, x, below));
      const Vec3 normal = glm::normalize(Vec3(-along_x, -along_y, 1));
      normals.rgba32.emplace_back(0.5f * normal + 0.5f, 1.0f);
    }
  }
  return normals;
}

}  // namespace candil
