/// A drawing of rectangles and words, and how it becomes a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/math.h"

namespace candil {

/// Red, green, blue from 0 to 255, sRGB.
using ChartColor = glm::u8vec3;

struct Chart {
  struct Rectangle {
    float x = 0, y = 0, width = 0, height = 0;  ///< Units from the upper left corner; about a pixel each.
    ChartColor color;
  };
  enum class Anchor { left, middle, right };
  struct Text {
    float x = 0, y = 0;  ///< Of the anchor, on the base line.
    Anchor anchor = Anchor::left;
    std::string text;
    ChartColor color{0, 0, 0};
  };

  float width = 0, height = 0;
  std::vector<Rectangle> rectangles;  ///< Later ones cover earlier ones.
  std::vector<Text> texts;            ///< On top.
};

/// Height of the letters of all texts.
inline constexpr float chart_text_size = 12;

/// Scalable, words as text.
std::string chart_svg(const Chart& chart);
/// Two pixels for each unit, words in a font of 5 x 7 pixels; for write_image() as display values.
Image chart_image(const Chart& chart);
/// Width that the words of a text need at the most.
float chart_text_width(const std::string& text);

}  // namespace candil
