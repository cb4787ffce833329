#include "core/tonemap_curves.h"

#include <algorithm>
#include <cmath>

namespace candil {
namespace {

using DMat3 = glm::dmat3;

/// From rows, as papers print matrices; GLM takes columns.
DMat3 from_rows(DVec3 first, DVec3 second, DVec3 third) { return glm::transpose(DMat3(first, second, third)); }

DVec3 hill_curve(DVec3 v) {
  const DVec3 numerator = v * (v + 0.0245786) - 0.000090537;
  const DVec3 denominator = v * (0.983729 * v + 0.4329510) + 0.238081;
  return numerator / denominator;
}

/// Wrensch's polynomial of degree 6 for AgX's contrast curve, from [0, 1] to [0, 1].
DVec3 agx_contrast(DVec3 x) {
  constexpr double coefficients[] = {15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232};
  DVec3 sum(0);
  for (const double coefficient : coefficients) sum = sum * x + coefficient;
  return sum;
}

}  // namespace

DVec3 neutral_tonemap(DVec3 color) {
  constexpr double fresnel = 0.04;  // what a dielectric of index 1.5 adds to its base colour at normal incidence
  constexpr double start_compression = 0.8 - fresnel;
  constexpr double desaturation = 0.15;
  constexpr double headroom = 1 - start_compression;

  const double low = std::min({color.x, color.y, color.z});
  color -= low < 2 * fresnel ? low - low * low / (4 * fresnel) : fresnel;
  const double peak = std::max({color.x, color.y, color.z});
  if (peak < start_compression) return color;

  const double new_peak = 1 - headroom * headroom / (peak + headroom - start_compression);
  color *= new_peak / peak;
  const double whiteness = 1 - 1 / (desaturation * (peak - new_peak) + 1);
  return glm::mix(color, DVec3(new_peak), whiteness);
}

DVec3 aces_tonemap(DVec3 color) {
  static const DMat3 to_rrt =
      from_rows({0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777});
  static const DMat3 from_odt =
      from_rows({1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602});
  return from_odt * hill_curve(to_rrt * color);
}

DVec3 agx_tonemap(DVec3 color, double power, double saturation) {
  static const DMat3 inset = from_rows({0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                       {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                       {0.0423756549057051, 0.0784336, 0.879142973793104});
  static const DMat3 outset = from_rows({1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                        {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                        {-0.0529716355144438, -0.0980434501171241, 1.15107367264116});
  constexpr double lowest_stop = -12.47393, highest_stop = 4.026069;  // log2; 0.18 is 10 stops above the lowest

  const DVec3 light = inset * color;
  DVec3 value;
  for (int i = 0; i < 3; ++i) {
    const double stop = light[i] > 0 ? std::clamp(std::log2(light[i]), lowest_stop, highest_stop) : lowest_stop;
    value[i] = (stop - lowest_stop) / (highest_stop - lowest_stop);
  }
  value = agx_contrast(value);
  const double grey = precise_luminance(value);
  value = grey + saturation * (glm::pow(glm::max(value, DVec3(0)), DVec3(power)) - grey);
  return outset * value;
}

}  // namespace candil
