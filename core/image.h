/// Pixels in memory. Knows no file format: io/ reads and writes them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/math.h"

namespace candil {

/// Linear float pixels, rows from top to bottom, channels interleaved.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;

  Image() = default;
  /// Black.
  Image(int columns, int rows, int samples_per_pixel)
      : width(columns),
        height(rows),
        channels(samples_per_pixel),
        pixels(static_cast<std::size_t>(columns) * rows * samples_per_pixel) {}

  bool empty() const { return pixels.empty(); }
  float* pixel(int x, int y) { return &pixels[(static_cast<std::size_t>(y) * width + x) * channels]; }
  const float* pixel(int x, int y) const { return &pixels[(static_cast<std::size_t>(y) * width + x) * channels]; }
};

/// A picture among others of the same size that go together, such as the layers of an EXR file.
struct ImageLayer {
  std::string name;                   ///< Empty: the picture itself.
  std::vector<std::string> channels;  ///< "X", "Y", "Z": as many as the image has.
  Image image;
};

/// A texture's pixels as the file stores them (not yet linear): RGBA, rows from top to bottom. Files of 8 bits a
/// channel stay at 8 bits, all others become float; exactly one of the two vectors is filled. What was absent in the
/// file is filled as glTF wants: one channel is copied to R, G and B, alpha is 1.
struct TextureImage {
  std::string name;  ///< File name or place in the scene file, for messages and `info`.
  int width = 0, height = 0;
  bool has_alpha = false;  ///< The file has an alpha channel.
  std::vector<glm::u8vec4> rgba8;
  std::vector<Vec4> rgba32;

  std::size_t bytes() const { return rgba8.size() * sizeof(glm::u8vec4) + rgba32.size() * sizeof(Vec4); }
};

}  // namespace candil
