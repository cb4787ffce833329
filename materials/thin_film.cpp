#include "materials/thin_film.h"

#include <cmath>
#include <numbers>

#include "materials/fresnel.h"

namespace candil {
namespace {

/// Of reflections that interfere. Belcour and Barla take 2 or 3; towards grazing angles each is hardly weaker than the
/// one before.
constexpr int max_order = 100;

/// Fourier transform of the CIE 1931 observer by Gaussians in the wave number (Belcour and Barla 2017, supplemental
/// code, as quoted in the extension's text), each normalised to 1 for path 0.
glm::dvec3 observer_xyz(double path_metres) {
  struct Gaussian {
    double value, position, variance;
  };
  const auto transform = [&](const Gaussian& g, double path) {
    const double phase = 2 * std::numbers::pi * path;
    return g.value * std::sqrt(g.variance) * std::cos(g.position * phase) * std::exp(-g.variance * phase * phase);
  };
  constexpr Gaussian x_red{5.4856e-13, 1.6810e6, 4.3278e9}, x_blue{9.7470e-14, 2.2399e6, 4.5282e9};
  constexpr Gaussian y{4.4201e-13, 1.7953e6, 9.3046e9}, z{5.2481e-13, 2.2084e6, 6.6121e9};
  return {
      (transform(x_red, path_metres) + transform(x_blue, path_metres)) / (transform(x_red, 0) + transform(x_blue, 0)),
      transform(y, path_metres) / transform(y, 0), transform(z, path_metres) / transform(z, 0)};
}

/// From XYZ relative to those of white, which is D65.
Vec3 rec709(glm::dvec3 relative_xyz) {
  const glm::dvec3 xyz = relative_xyz * glm::dvec3(0.95047, 1, 1.08883);
  const glm::dmat3 to_rec709(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560,
                             1.0572252);
  return Vec3(to_rec709 * xyz);
}

/// Amplitudes that one side of the film reflects, perpendicular and parallel to the plane of incidence; both are
/// positive at normal incidence where the index falls.
template <typename T>
struct Amplitudes {
  T perpendicular, parallel;
};

/// From the index n1 to n2.
template <typename T>
Amplitudes<T> fresnel_amplitudes(float n1, float cos1, T n2, T cos2) {
  return {(n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2), (n1 * cos2 - n2 * cos1) / (n1 * cos2 + n2 * cos1)};
}

/// The share of light that goes through, of one polarisation: T12 T23 / |1 + q e^(i phase)|^2 with q the product of
/// both amplitudes, as a series of cosines of multiples of the phase.
class Transmittance {
 public:
  Transmittance(float r12, Vec3 r23) : q_(r12 * r23), scale_((1 - sqr(r12)) * (1.0f - r23 * r23)) {}
  /// The next order, whose cosines are seen as `sensitivity`.
  void add(Vec3 sensitivity) {
    power_ *= -q_;
    series_ += power_ * sensitivity;
  }
  bool is_complete() const { return max_component(glm::abs(power_)) < 1e-3f; }
  Vec3 value() const { return scale_ / glm::max(1.0f - q_ * q_, 1e-6f) * series_; }

 private:
  Vec3 q_, scale_, power_{2.0f}, series_{1.0f};
};

Vec3 reflectance(const ThinFilm& film, float cos_film, Amplitudes<float> upper, const Amplitudes<Vec3>& lower) {
  const float path = 2 * film.ior * film.thickness * cos_film;
  Transmittance perpendicular(upper.perpendicular, lower.perpendicular), parallel(upper.parallel, lower.parallel);
  for (int order = 1; order <= max_order && !(perpendicular.is_complete() && parallel.is_complete()); ++order) {
    const float distance = static_cast<float>(order) * path;
    if (film.sensitivity->is_averaged_out(distance)) break;
    const Vec3 sensitivity = (*film.sensitivity)(distance);
    perpendicular.add(sensitivity), parallel.add(sensitivity);
  }
  return glm::clamp(1.0f - 0.5f * (perpendicular.value() + parallel.value()), 0.0f, 1.0f);
}

/// Cosine beyond an interface to a relative index, squared; negative under total reflection.
template <typename T>
T refracted_cosine_squared(float cosine, T eta) {
  return 1.0f - (1 - sqr(cosine)) / (eta * eta);
}

}  // namespace

FilmSensitivity::FilmSensitivity() {
  colors_.reserve(count);
  const Vec3 at_zero = rec709(observer_xyz(0));
  for (int i = 0; i < count; ++i) colors_.push_back(rec709(observer_xyz(i * (step * 1e-9))) / at_zero);
}

Vec3 film_reflectance_on_dielectric(const ThinFilm& film, Vec3 base_ior, float cosine) {
  const float squared = refracted_cosine_squared(cosine, film.ior);
  const Vec3 squared_base = refracted_cosine_squared(cosine, base_ior);
  if (!(squared > 0)) return Vec3(1);
  const float cos_film = glm::sqrt(squared);
  const Vec3 cos_base = glm::sqrt(glm::max(squared_base, Vec3(0)));
  return reflectance(film, cos_film, fresnel_amplitudes(1.0f, cosine, film.ior, cos_film),
                     fresnel_amplitudes(film.ior, cos_film, base_ior, cos_base));
}

Vec3 film_reflectance_on_metal(const ThinFilm& film, Vec3 base_f0, float cosine) {
  const float squared = refracted_cosine_squared(cosine, film.ior);
  if (!(squared > 0)) return Vec3(1);
  const float cos_film = glm::sqrt(squared);
  // As the text has it: a real index from the reflectance in air, the reflectance below the film from that index.
  const Vec3 amplitude = (film.ior - ior_of_reflectance(base_f0)) / (film.ior + ior_of_reflectance(base_f0));
  const Vec3 lower = glm::sqrt(fresnel_schlick(amplitude * amplitude, Vec3(1), cos_film)) * glm::sign(amplitude);
  return reflectance(film, cos_film, fresnel_amplitudes(1.0f, cosine, film.ior, cos_film), {lower, lower});
}

Vec3 ior_of_reflectance(Vec3 f0) {
  const Vec3 root = glm::sqrt(glm::clamp(f0, 0.0f, 0.9999f));
  return (1.0f + root) / (1.0f - root);
}

}  // namespace candil
