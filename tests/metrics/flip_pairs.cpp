#include "tests/metrics/flip_pairs.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>

namespace candil::test {
namespace {

constexpr int width = 48, height = 40;

using Color = std::array<double, 3>;
using MakeColor = std::function<Color(int x, int y)>;

std::uint32_t mix(std::uint32_t value) {
  for (const std::uint32_t factor : {0x7feb352du, 0x846ca68bu}) value = (value ^ (value >> 16)) * factor;
  return value ^ (value >> 15);
}

/// Numbers in [0, 1).
double noise(int seed, int x, int y, int channel) {
  const auto index = static_cast<std::uint32_t>((y * width + x) * 3 + channel);
  return (mix(index + static_cast<std::uint32_t>(seed) * 1000003u) >> 8) / 16777216.0;
}

MakeColor color_noise(int seed, double offset = 0, double scale = 1) {
  return [=](int x, int y) {
    Color color;
    for (int c = 0; c < 3; ++c) color[static_cast<std::size_t>(c)] = offset + scale * noise(seed, x, y, c);
    return color;
  };
}

MakeColor constant(double red, double green, double blue) {
  return [=](int, int) { return Color{red, green, blue}; };
}

double disc(int x, int y, int center_x, int center_y, int radius) {
  const int dx = x - center_x, dy = y - center_y;
  return dx * dx + dy * dy < radius * radius ? 1 : 0;
}

MakeColor gradient(int shift) {
  return [=](int x, int y) {
    return Color{(x + shift) / (width + 1.0), y / static_cast<double>(height),
                 (x + y + shift) / (width + height + 1.0)};
  };
}

MakeColor green_disc(int center_x, int center_y) {
  return [=](int x, int y) { return Color{0.2, 0.3 + 0.5 * disc(x, y, center_x, center_y, 9), 0.7}; };
}

MakeColor lines(int period) {
  return [=](int x, int) {
    const double value = (x % period < 1 ? 0.75 : 0) + 0.125;
    return Color{value, value, value};
  };
}

MakeColor spike(double base, double value) {
  return [=](int x, int y) {
    const double here = x == width / 2 && y == height / 2 ? value : base;
    return Color{here, here, here};
  };
}

Color slope(int x, int y) { return {std::exp2(x / 4.0 - 5), std::exp2(x / 5.0 - 4), std::exp2(y / 4.0 - 5)}; }

MakeColor lamp(int center_x) {
  return [=](int x, int y) {
    const double light = 100 * disc(x, y, center_x, 18, 6);
    return Color{0.1 + light, 0.2 + light, 0.15 + 0.01 * y};
  };
}

MakeColor half_black(int seed) {
  return [=](int x, int y) { return y > 24 ? color_noise(seed)(x, y) : Color{0, 0, 0}; };
}

/// combine(first, second), channel by channel.
MakeColor combined(const MakeColor& first, const MakeColor& second,
                   const std::function<double(double, double)>& combine) {
  return [=](int x, int y) {
    const Color a = first(x, y), b = second(x, y);
    return Color{combine(a[0], b[0]), combine(a[1], b[1]), combine(a[2], b[2])};
  };
}

struct Makers {
  MakeColor a, b;
};

std::map<std::string, Makers> display_pairs() {
  return {{"noise", {color_noise(1), color_noise(2)}},
          {"faint noise", {constant(0.5, 0.5, 0.5), color_noise(3, 0.45, 0.1)}},
          {"gradient", {gradient(0), gradient(1)}},
          {"disc", {green_disc(20, 18), green_disc(22, 19)}},
          {"colour", {constant(0.2, 0.6, 0.4), constant(0.28, 0.55, 0.4)}},
          {"lines", {lines(3), lines(4)}},
          {"dark noise", {color_noise(4, 0, 0.06), color_noise(5, 0, 0.06)}},
          {"spike", {spike(0.3, 0.3), spike(0.3, 1)}},
          {"green and blue", {constant(0, 1, 0), constant(0, 0, 1)}}};
}

std::map<std::string, Makers> linear_pairs() {
  const MakeColor range = [](int x, int y) {
    const Color u = color_noise(6)(x, y);
    return Color{std::exp2(8 * u[0] - 4), std::exp2(8 * u[1] - 4), std::exp2(8 * u[2] - 4)};
  };
  const auto product = [](double a, double b) { return a * b; };
  const auto sum = [](double a, double b) { return a + b; };
  const MakeColor grain = color_noise(8, 0.25, 0.1);
  return {{"range", {range, combined(range, color_noise(7, 0.9, 0.2), product)}},
          {"slope", {slope, combined(constant(1.1, 1.1, 1.1), slope, product)}},
          {"lamp", {lamp(20), lamp(21)}},
          {"firefly", {grain, combined(grain, spike(0, 50), sum)}},
          {"mostly black", {half_black(9), half_black(10)}},
          {"constant", {constant(1, 1, 1), constant(2, 2, 2)}},
          {"dim", {color_noise(11, 0.0005, 0.001), color_noise(12, 0.0005, 0.001)}},
          {"negative", {color_noise(13, -0.1), color_noise(14, -0.1)}}};
}

Image make_image(const MakeColor& make, bool is_8_bit) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Color color = make(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = static_cast<float>(is_8_bit ? std::floor(color[c] * 255 + 0.5) / 255 : color[c]);
    }
  return image;
}

}  // namespace

FlipPair make_flip_pair(const std::string& name) {
  const std::map<std::string, Makers> display = display_pairs(), linear = linear_pairs();
  const bool is_display = display.contains(name);
  const Makers& makers = is_display ? display.at(name) : linear.at(name);
  return {make_image(makers.a, is_display), make_image(makers.b, is_display)};
}

}  // namespace candil::test
