#include <algorithm>
#include <cmath>

#include "apps/chart.h"
#include "apps/pixel_font.h"

namespace candil {
namespace {

constexpr int pixels_per_unit = 2;
constexpr int glyph_scale = 2;  // pixels for each pixel of the font
constexpr int glyph_advance = (glyph_width + 1) * glyph_scale;

int to_pixels(float units) { return static_cast<int>(std::lround(units * pixels_per_unit)); }

class Canvas {
 public:
  Canvas(float width, float height) : image_(to_pixels(width), to_pixels(height), 3) {
    std::ranges::fill(image_.pixels, 1.0f);
  }

  void fill(int left, int top, int right, int bottom, ChartColor color) {
    const Vec3 value = Vec3(color) / 255.0f;
    for (int y = std::max(top, 0); y < std::min(bottom, image_.height); ++y) {
      for (int x = std::max(left, 0); x < std::min(right, image_.width); ++x) {
        for (int c = 0; c < 3; ++c) image_.pixel(x, y)[c] = value[c];
      }
    }
  }

  void write(int x, int baseline, const std::string& text, ChartColor color) {
    for (const char c : text) {
      const Glyph& glyph = glyph_of(c);
      for (int row = 0; row < glyph_height; ++row) {
        for (int column = 0; column < glyph_width; ++column) {
          if (!(glyph[row] >> (glyph_width - 1 - column) & 1)) continue;
          const int left = x + column * glyph_scale, top = baseline + (row - glyph_ascent) * glyph_scale;
          fill(left, top, left + glyph_scale, top + glyph_scale, color);
        }
      }
      x += glyph_advance;
    }
  }

  Image& image() { return image_; }

 private:
  Image image_;
};

int left_of(const Chart::Text& text) {
  const int width = static_cast<int>(text.text.size()) * glyph_advance;
  switch (text.anchor) {
    case Chart::Anchor::left:
      break;
    case Chart::Anchor::middle:
      return to_pixels(text.x) - width / 2;
    case Chart::Anchor::right:
      return to_pixels(text.x) - width;
  }
  return to_pixels(text.x);
}

}  // namespace

Image chart_image(const Chart& chart) {
  Canvas canvas(chart.width, chart.height);
  for (const Chart::Rectangle& r : chart.rectangles) {
    // At least a pixel of a line that is thinner.
    const int left = to_pixels(r.x), top = to_pixels(r.y);
    canvas.fill(left, top, std::max(to_pixels(r.x + r.width), left + 1), std::max(to_pixels(r.y + r.height), top + 1),
                r.color);
  }
  for (const Chart::Text& text : chart.texts) canvas.write(left_of(text), to_pixels(text.y), text.text, text.color);
  return std::move(canvas.image());
}

float chart_text_width(const std::string& text) {
  // Common sans-serif fonts are narrower on the average.
  constexpr float advance = 0.6f * chart_text_size;
  return advance * static_cast<float>(text.size());
}

}  // namespace candil
