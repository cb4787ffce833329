/// One wavelength for a path that a medium bends by it (KHR_materials_dispersion). Everything else is in red, green and
/// blue: a path takes a wavelength where it first enters a dispersive volume, and is worth that wavelength's colour
/// from there on.
///
/// The colours are those of spectral light in linear Rec.709, the CIE 1931 observer by the lobes of Wyman, Sloan and
/// Shirley 2013 ("Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2)). What lies
/// outside of the gamut is cut off at zero, so that no path is worth less than nothing, and each channel is scaled such
/// that all wavelengths together are white. Wavelengths are chosen in proportion to the sum of the three, which keeps
/// the worth of a path between 0 and little more than 3.
#pragma once

#include "core/math.h"

namespace candil {

/// Nanometres; others are never chosen.
inline constexpr float shortest_wavelength = 400, longest_wavelength = 680;

struct Wavelength {
  float nanometres = 0;  ///< 0: all of them together.
  Vec3 response{1.0f};   ///< Colour over the density of the choice, for a path that takes it.
};

/// The wavelength for a random number in [0, 1). The mean of the response over all u is exactly (1, 1, 1). Its total
/// variation is below 7, so that numbers of which one lies in each of N equal intervals miss that by 7 / N at most.
Wavelength sample_wavelength(float u);

/// Index of refraction at a wavelength: Cauchy's equation through `ior` at 587.56 nm, with dispersion = 20 / Abbe
/// number (KHR_materials_dispersion). Never below 1.
inline float dispersed_ior(float ior, float dispersion, float nanometres) {
  return glm::max(ior + (ior - 1) * (dispersion / 20) * (523655 / sqr(nanometres) - 1.5168f), 1.0f);
}

}  // namespace candil
