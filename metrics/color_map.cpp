#include "metrics/color_map.h"

#include <algorithm>
#include <cmath>

#include "metrics/parallel_rows.h"

namespace candil {
namespace {

using Color = std::array<std::uint8_t, 3>;

std::array<Color, 256> make_colors() {
  // Evenly spaced along the way; between them straight lines.
  constexpr std::array<std::array<int, 3>, 10> stops = {{{0, 0, 4},
                                                         {24, 15, 62},
                                                         {69, 16, 119},
                                                         {114, 31, 129},
                                                         {159, 47, 127},
                                                         {205, 64, 113},
                                                         {241, 96, 93},
                                                         {253, 149, 103},
                                                         {254, 202, 141},
                                                         {252, 253, 191}}};
  std::array<Color, 256> colors{};
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const double place = static_cast<double>(i) / 255 * (stops.size() - 1);
    const std::size_t stop = std::min(static_cast<std::size_t>(place), stops.size() - 2);
    const double rest = place - static_cast<double>(stop);
    for (std::size_t c = 0; c < 3; ++c)
      colors[i][c] = static_cast<std::uint8_t>(std::lround(stops[stop][c] * (1 - rest) + stops[stop + 1][c] * rest));
  }
  return colors;
}

}  // namespace

const std::array<Color, 256>& heat_colors() {
  static const std::array<Color, 256> colors = make_colors();
  return colors;
}

Image heat_map(const Image& map, float largest) {
  Image picture(map.width, map.height, 3);
  const auto& colors = heat_colors();
  for_each_row(map.height, [&](int y) {
    for (int x = 0; x < map.width; ++x) {
      const float value = *map.pixel(x, y) / largest;
      const float shade = value < 1 ? std::max(value, 0.0f) : 1.0f;
      const Color& color = colors[static_cast<std::size_t>(shade * 255 + 0.5f)];
      for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = static_cast<float>(color[static_cast<std::size_t>(c)]) / 255;
    }
  });
  return picture;
}

}  // namespace candil
