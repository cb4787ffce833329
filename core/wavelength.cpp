#include "core/wavelength.h"

#include <array>
#include <cmath>

namespace candil {
namespace {

/// Knots of the choice, at equal steps of u; between them all is linear.
constexpr int interval_count = 256;

struct Choice {
  std::array<float, interval_count + 1> nanometres;
  std::array<Vec3, interval_count + 1> response;
};

/// A bell with another width on each side.
double bell(double x, double mean, double width_below, double width_above) {
  const double t = (x - mean) / (x < mean ? width_below : width_above);
  return std::exp(-0.5 * t * t);
}

/// Colour of spectral light, where the gamut has it.
glm::dvec3 spectral_color(double nm) {
  const double x =
      1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) - 0.065 * bell(nm, 501.1, 20.4, 26.2);
  const double y = 0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1);
  const double z = 1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8);
  // IEC 61966-2-1, from CIE XYZ.
  const glm::dvec3 rgb(3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
                       0.0557 * x - 0.2040 * y + 1.0570 * z);
  return glm::max(rgb, glm::dvec3(0));
}

Choice make_choice() {
  constexpr double step = 0.1;
  constexpr int count = static_cast<int>((longest_wavelength - shortest_wavelength) * 10);  // of steps
  const auto wavelength = [&](double i) { return shortest_wavelength + step * i; };
  glm::dvec3 sum(0);
  for (int i = 0; i < count; ++i) sum += spectral_color(wavelength(i + 0.5));
  const auto color = [&](double nm) { return spectral_color(nm) / sum; };  // all together: 1 in each channel
  const auto density = [](glm::dvec3 c) { return (c.x + c.y + c.z) / 3; };

  Choice choice;
  glm::dvec3 mean(0);
  std::array<glm::dvec3, interval_count + 1> response;
  double below = 0;  // share of the wavelengths up to the step
  int i = 0;
  double in_step = density(color(wavelength(0.5)));
  for (int k = 0; k <= interval_count; ++k) {
    const double u = static_cast<double>(k) / interval_count;
    while (i + 1 < count && below + in_step < u) {
      below += in_step;
      in_step = density(color(wavelength(++i + 0.5)));
    }
    const double nm = wavelength(i + glm::clamp((u - below) / in_step, 0.0, 1.0));
    choice.nanometres[k] = static_cast<float>(nm);
    response[k] = color(nm) / density(color(nm));
    mean += response[k] * (k == 0 || k == interval_count ? 0.5 : 1.0) / static_cast<double>(interval_count);
  }
  // The mean of what is linear between the knots, by the trapezoidal rule.
  for (int k = 0; k <= interval_count; ++k) choice.response[k] = Vec3(response[k] / mean);
  return choice;
}

const Choice choice = make_choice();

}  // namespace

Wavelength sample_wavelength(float u) {
  const float position = u * interval_count;
  const int k = glm::min(static_cast<int>(position), interval_count - 1);
  const float fraction = position - static_cast<float>(k);
  return {glm::mix(choice.nanometres[k], choice.nanometres[k + 1], fraction),
          glm::mix(choice.response[k], choice.response[k + 1], fraction)};
}

}  // namespace candil
