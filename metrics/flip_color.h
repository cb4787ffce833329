/// The colour spaces of FLIP, pixel by pixel in a form that compilers vectorise. Always inline: see core/bvh/target.h.
#pragma once

#include "metrics/fast_math.h"

namespace candil {

/// Opponent colours, linear in light. With X, Y and Z as shares of those of white: luminance Y, red-green X - Y,
/// blue-yellow Y - Z. They are the paper's YCxCz without its factors, which drop out.
struct Opponent {
  float luminance, red_green, blue_yellow;
};

/// CIELAB, chroma without its factors 500 of a and 200 of b.
struct HuntLab {
  float lightness, a, b;
};

/// Section 4.1.3 of the paper of 2020.
inline constexpr float color_exponent = 0.7f;

/// A row: X, Y or Z of linear Rec.709 (IEC 61966-2-1), divided by that of white, so that rows sum up to 1.
struct WhiteXyz {
  float red, green, blue;
};
constexpr WhiteXyz white_xyz(double red, double green, double blue) {
  const double white = red + green + blue;
  return {static_cast<float>(red / white), static_cast<float>(green / white), static_cast<float>(blue / white)};
}
inline constexpr WhiteXyz x_row = white_xyz(0.4123908, 0.3575843, 0.1804808);
inline constexpr WhiteXyz y_row = white_xyz(0.2126390, 0.7151687, 0.0721923);
inline constexpr WhiteXyz z_row = white_xyz(0.0193308, 0.1191948, 0.9505322);

/// What X - Y and Y - Z add to linear Rec.709, beside Y for all three: the rows' inverse takes X = Y = Z to grey.
struct FromOpponent {
  float red_green[3], blue_yellow[3];
};
constexpr FromOpponent make_from_opponent() {
  constexpr double x[] = {x_row.red, x_row.green, x_row.blue}, y[] = {y_row.red, y_row.green, y_row.blue};
  constexpr double z[] = {z_row.red, z_row.green, z_row.blue};
  FromOpponent from{};
  double determinant = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += x[i] * (y[j] * z[k] - y[k] * z[j]);
  }
  // Columns X and Z of the inverse, by Cramer's rule; that of Z with the sign of Y - Z.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    from.red_green[i] = static_cast<float>((y[j] * z[k] - y[k] * z[j]) / determinant);
    from.blue_yellow[i] = static_cast<float>(-(x[j] * y[k] - x[k] * y[j]) / determinant);
  }
  return from;
}
inline constexpr FromOpponent from_opponent = make_from_opponent();

/// Loops are vectorised only if all that they call is inlined.
[[gnu::always_inline]] inline float dot(const WhiteXyz& row, float red, float green, float blue) {
  return multiply_add(row.red, red, multiply_add(row.green, green, row.blue * blue));
}

/// From linear Rec.709 in [0, 1].
[[gnu::always_inline]] inline Opponent to_opponent(float red, float green, float blue) {
  const float y = dot(y_row, red, green, blue);
  return {y, dot(x_row, red, green, blue) - y, y - dot(z_row, red, green, blue)};
}

/// CIE 15: the cube root, with a straight line near black.
[[gnu::always_inline]] inline float lab_curve(float t) {
  constexpr float delta = 6 / 29.0f;
  const float root = fast_cbrt(t), line = multiply_add(t, 1 / (3 * delta * delta), 4 / 29.0f);
  return t > delta * delta * delta ? root : line;
}

/// One of linear Rec.709, cut to [0, 1].
template <int channel>
[[gnu::always_inline]] inline float rec709(const Opponent& color) {
  constexpr float red_green = from_opponent.red_green[channel], blue_yellow = from_opponent.blue_yellow[channel];
  const float v =
      multiply_add(red_green, color.red_green, multiply_add(blue_yellow, color.blue_yellow, color.luminance));
  return smaller(larger(v, 0), 1);  // negative floats have negative bits
}

/// CIELAB of filtered opponent colours, with the chroma of dark colours lessened (Hunt's effect; section 4.1.2 of the
/// paper of 2020). Colours beyond Rec.709 are cut to it.
[[gnu::always_inline]] inline HuntLab to_hunt_lab(const Opponent& color) {
  const float red = rec709<0>(color), green = rec709<1>(color), blue = rec709<2>(color);
  const float fx = lab_curve(dot(x_row, red, green, blue));
  const float fy = lab_curve(dot(y_row, red, green, blue));
  const float fz = lab_curve(dot(z_row, red, green, blue));
  const float lightness = multiply_add(116, fy, -16), hunt = 0.01f * lightness;
  return {lightness, hunt * (fx - fy), hunt * (fy - fz)};
}

/// Section 4.1.3: the sum of the differences of lightness and of chroma (HyAB; Abasi et al. 2020).
[[gnu::always_inline]] inline float color_distance(const HuntLab& p, const HuntLab& q) {
  const float lightness = p.lightness - q.lightness, a = 500 * (p.a - q.a), b = 200 * (p.b - q.b);
  return __builtin_fabsf(lightness) + fast_sqrt(multiply_add(a, a, b * b));
}

/// The largest difference of colours, between green and blue, raised to color_exponent.
float largest_color_difference();

}  // namespace candil
