#include "metrics/flip_color.h"

#include <cmath>

namespace candil {

float largest_color_difference() {
  const HuntLab green = to_hunt_lab(to_opponent(0, 1, 0)), blue = to_hunt_lab(to_opponent(0, 0, 1));
  return std::pow(color_distance(green, blue), color_exponent);
}

}  // namespace candil
