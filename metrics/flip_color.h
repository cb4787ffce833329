/// The colour spaces of FLIP, row by row in a form that compilers vectorise.
#pragma once

namespace candil {

/// One row of opponent colours, linear in light. With X, Y and Z as shares of those of white: luminance Y, red-green
/// X - Y, blue-yellow Y - Z. They are the paper's YCxCz without its factors, which drop out.
struct OpponentRow {
  float* luminance;
  float* red_green;
  float* blue_yellow;
};

/// From linear Rec.709 in [0, 1].
void to_opponent(const float* red, const float* green, const float* blue, const OpponentRow& out, int count);

/// CIELAB of a row of filtered opponent colours, with the chroma of dark colours lessened (Hunt's effect; section 4.1.2
/// of the paper of 2020): L, a, b replace luminance, red-green, blue-yellow. Colours beyond Rec.709 are cut to it.
void to_hunt_lab(const OpponentRow& row, int count);

/// The largest difference of colours, between green and blue, by the distance below and raised to color_exponent.
float largest_color_difference();

/// Section 4.1.3.
inline constexpr float color_exponent = 0.7f;

}  // namespace candil
