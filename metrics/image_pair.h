/// Two images to compare, and which of their pixels count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"

namespace candil {

/// What the numbers of an image stand for.
enum class ValueKind {
  display,  ///< Colour as a screen gets it: sRGB in [0, 1].
  linear,   ///< Radiance: linear Rec.709, any range.
  data      ///< Anything else: depth, normals, ids. Compared as numbers only.
};

/// A is what is wanted (the reference), B what is tested. The same size and number of channels; colour has 3, or 4
/// where the last one is alpha and the others are multiplied by it. The images outlive the pair.
struct ImagePair {
  const Image& a;
  const Image& b;
  ValueKind kind = ValueKind::linear;

  int width() const { return a.width; }
  int height() const { return a.height; }
  bool is_color() const { return kind != ValueKind::data; }
};

/// b - a. Two NaN, or twice the same infinity, differ by 0; other pairs with a value that is not finite by infinity.
inline float difference(float a, float b) {
  const float d = b - a;
  if (d - d == 0) return d;  // finite
  const bool is_same = a == b || (a != a && b != b);
  if (is_same) return 0;
  return d < 0 ? -infinity : infinity;
}

/// A rectangle of pixels; x and y of its upper left corner.
struct Region {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The pixels that count: all of them, or those marked.
class PixelSelection {
 public:
  /// All pixels of an image.
  PixelSelection(int width, int height);

  /// Leaves only the pixels in one of the regions, which lie within the image.
  void keep(const std::vector<Region>& regions);
  /// Leaves only the pixels where the first channel of the mask, of the same size, is at least `threshold`.
  void keep(const Image& mask, float threshold = 0.5f);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t count() const { return count_; }
  bool is_everything() const { return marks_.empty(); }
  bool contains(std::size_t pixel) const { return marks_.empty() || marks_[pixel] != 0; }
  bool contains(int x, int y) const { return contains(static_cast<std::size_t>(y) * width_ + x); }

 private:
  void count_marks();

  int width_, height_;
  std::size_t count_;
  std::vector<std::uint8_t> marks_;  // empty: all
};

}  // namespace candil
