#include "metrics/flip_color.h"

#include <cmath>

#include "core/math.h"
#include "metrics/fast_math.h"

namespace candil {
namespace {

/// Rows: X, Y, Z of linear Rec.709 (IEC 61966-2-1), each divided by that of white, so that rows sum up to 1.
struct WhiteXyz {
  float red, green, blue;
};
constexpr WhiteXyz make_row(double red, double green, double blue) {
  const double white = red + green + blue;
  return {static_cast<float>(red / white), static_cast<float>(green / white), static_cast<float>(blue / white)};
}
constexpr WhiteXyz x_row = make_row(0.4123908, 0.3575843, 0.1804808);
constexpr WhiteXyz y_row = make_row(0.2126390, 0.7151687, 0.0721923);
constexpr WhiteXyz z_row = make_row(0.0193308, 0.1191948, 0.9505322);

/// Loops are vectorised only if all that they call is inlined.
[[gnu::always_inline]] inline float dot(const WhiteXyz& row, float red, float green, float blue) {
  return multiply_add(row.red, red, multiply_add(row.green, green, row.blue * blue));
}

/// The inverse: linear Rec.709 of X, Y, Z over white. Columns of glm matrices come first.
const glm::dmat3 to_rgb = glm::inverse(glm::transpose(glm::dmat3(
    x_row.red, x_row.green, x_row.blue, y_row.red, y_row.green, y_row.blue, z_row.red, z_row.green, z_row.blue)));

[[gnu::always_inline]] inline float unit(float v) { return v > 0 ? (v < 1 ? v : 1.0f) : 0.0f; }

/// CIE 15: the cube root, with a straight line near black.
[[gnu::always_inline]] inline float lab_curve(float t) {
  constexpr float delta = 6 / 29.0f;
  const float root = fast_cbrt(t), line = multiply_add(t, 1 / (3 * delta * delta), 4 / 29.0f);
  return t > delta * delta * delta ? root : line;
}

}  // namespace

void to_opponent(const float* __restrict red, const float* __restrict green, const float* __restrict blue,
                 const OpponentRow& out, int count) {
  float* const __restrict luminance = out.luminance;
  float* const __restrict red_green = out.red_green;
  float* const __restrict blue_yellow = out.blue_yellow;
  for (int i = 0; i < count; ++i) {
    const float y = dot(y_row, red[i], green[i], blue[i]);
    luminance[i] = y;
    red_green[i] = dot(x_row, red[i], green[i], blue[i]) - y;
    blue_yellow[i] = y - dot(z_row, red[i], green[i], blue[i]);
  }
}

void to_hunt_lab(const OpponentRow& row, int count) {
  float* const __restrict luminance = row.luminance;
  float* const __restrict red_green = row.red_green;
  float* const __restrict blue_yellow = row.blue_yellow;
  const Mat3 m(to_rgb);
  for (int i = 0; i < count; ++i) {
    const float y = luminance[i], x = red_green[i] + y, z = y - blue_yellow[i];
    const float red = unit(multiply_add(m[0].x, x, multiply_add(m[1].x, y, m[2].x * z)));
    const float green = unit(multiply_add(m[0].y, x, multiply_add(m[1].y, y, m[2].y * z)));
    const float blue = unit(multiply_add(m[0].z, x, multiply_add(m[1].z, y, m[2].z * z)));
    const float fx = lab_curve(dot(x_row, red, green, blue));
    const float fy = lab_curve(dot(y_row, red, green, blue));
    const float fz = lab_curve(dot(z_row, red, green, blue));
    const float lightness = multiply_add(116, fy, -16), hunt = 0.01f * lightness;
    luminance[i] = lightness;
    red_green[i] = hunt * (500 * (fx - fy));
    blue_yellow[i] = hunt * (200 * (fy - fz));
  }
}

float largest_color_difference() {
  float red[2] = {0, 0}, green[2] = {1, 0}, blue[2] = {0, 1};
  float l[2], a[2], b[2];
  const OpponentRow row = {l, a, b};
  to_opponent(red, green, blue, row, 2);
  to_hunt_lab(row, 2);
  const float distance = std::abs(l[0] - l[1]) + std::hypot(a[0] - a[1], b[0] - b[1]);
  return std::pow(distance, color_exponent);
}

}  // namespace candil
