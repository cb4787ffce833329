#include "metrics/image_pair.h"

#include <algorithm>

namespace candil {

PixelSelection::PixelSelection(int width, int height)
    : width_(width), height_(height), count_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void PixelSelection::keep(const std::vector<Region>& regions) {
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(width_) * height_, 0);
  for (const Region& region : regions)
    for (int y = region.y; y < region.y + region.height; ++y)
      for (int x = region.x; x < region.x + region.width; ++x)
        kept[static_cast<std::size_t>(y) * width_ + x] = contains(x, y) ? 1 : 0;
  marks_ = std::move(kept);
  count_marks();
}

void PixelSelection::keep(const Image& mask, float threshold) {
  std::vector<std::uint8_t> kept(static_cast<std::size_t>(width_) * height_, 0);
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i] = contains(i) && mask.pixels[i * mask.channels] >= threshold ? 1 : 0;
  marks_ = std::move(kept);
  count_marks();
}

void PixelSelection::count_marks() { count_ = static_cast<std::size_t>(std::ranges::count(marks_, 1)); }

}  // namespace candil
