/// Interference in a thin transparent film on top of an interface (KHR_materials_iridescence; Belcour and Barla 2017,
/// "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence").
///
/// The reflectance of a film is a series of cosines in the phase between reflections (Airy's sum), and each cosine has
/// a colour that depends on the optical path alone: the Fourier transform of the observer's sensitivity. The
/// extension's text evaluates Belcour and Barla's Gaussians for it; here they fill a table, once per scene. Where its
/// outline is an approximation, this is exact: both polarisations follow Fresnel's equations at both sides of the film,
/// with the sign of their amplitudes. Over a metal, of which only the reflectance is known, Schlick's curve stands at
/// the lower side.
#pragma once

#include <vector>

#include "core/math.h"

namespace candil {

/// Colour of cos(2 pi d / wavelength) as the spectrum of a reflectance, by the optical path d, under white light. At
/// d = 0 it is 1, which makes a film of no thickness the bare interface, and white stay white (the text's constants
/// would be those of an observer who takes the spectrum of equal energy for the white of Rec.709).
class FilmSensitivity {
 public:
  FilmSensitivity();

  /// A path after which nothing is left of colours.
  bool is_averaged_out(float path) const { return !(path < step * static_cast<float>(count - 1)); }
  /// Nanometres, not negative.
  Vec3 operator()(float path) const {
    if (is_averaged_out(path)) return Vec3(0);
    const float position = path * (1 / step);
    const std::size_t index = static_cast<std::size_t>(position);
    return glm::mix(colors_[index], colors_[index + 1], position - static_cast<float>(index));
  }

 private:
  static constexpr float step = 4;  // nanometres
  static constexpr int count = 2500;
  std::vector<Vec3> colors_;
};

/// A film in air.
struct ThinFilm {
  const FilmSensitivity* sensitivity = nullptr;  ///< Null: there is no film.
  float share = 0;                               ///< Of the surface that it covers.
  float ior = 1.3f;
  float thickness = 400;  ///< Nanometres.

  explicit operator bool() const { return sensitivity != nullptr; }
};

/// Reflectance of `film` on a dielectric of an index per channel, each positive; `cosine` in air, in [0, 1].
Vec3 film_reflectance_on_dielectric(const ThinFilm& film, Vec3 base_ior, float cosine);
/// The same on a metal that reflects base_f0 in air, at normal incidence.
Vec3 film_reflectance_on_metal(const ThinFilm& film, Vec3 base_f0, float cosine);

/// The index, at least 1, of what reflects f0 in air.
Vec3 ior_of_reflectance(Vec3 f0);

}  // namespace candil
