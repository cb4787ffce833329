// Thin films against an independent calculation: the characteristic matrix of a layer (Born and Wolf, "Principles of
// Optics", section 1.6), wavelength by wavelength in double precision, seen by another fit of the CIE 1931 observer.
#include "materials/thin_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "materials/fresnel.h"

namespace candil::test {
namespace {

using Complex = std::complex<double>;

/// Reflectance of a film of index n on a base, in air, of one polarisation.
double layer_reflectance(double n, double base, double thickness, double wavelength, double cosine, bool parallel) {
  const double sine = std::sqrt(1 - cosine * cosine);
  const auto cosine_in = [&](double index) { return std::sqrt(Complex(1 - sine * sine / (index * index))); };
  const auto admittance = [&](double index) {
    return parallel ? cosine_in(index) / index : index * cosine_in(index);  // of the magnetic or the electric field
  };
  const Complex phase = 2 * pi / wavelength * n * thickness * cosine_in(n), p = admittance(n), i(0, 1);
  const Complex m11 = std::cos(phase), m12 = -i / p * std::sin(phase), m21 = -i * p * std::sin(phase);
  const Complex first = admittance(1), last = admittance(base);
  const Complex a = (m11 + m12 * last) * first, b = m21 + m11 * last;
  return std::norm((a - b) / (a + b));
}

/// Wyman, Sloan and Shirley 2013, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions".
glm::dvec3 observer(double wavelength) {
  const auto lobe = [&](double height, double center, double below, double above) {
    const double t = (wavelength - center) / (wavelength < center ? below : above);
    return height * std::exp(-0.5 * t * t);
  };
  return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
          lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
          lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

/// CIE standard illuminant D65 from 380 nm in steps of 20 nm, linear between them.
double daylight(double wavelength) {
  constexpr std::array values{49.98, 82.75, 93.43, 104.86, 117.81, 115.92, 109.35, 104.79, 104.41, 100.0, 95.79,
                              90.01, 87.70, 83.70, 80.21,  78.28,  71.61,  61.60,  75.09,  46.42,  63.38};
  const double position = (wavelength - 380) / 20;
  const auto index = std::min(static_cast<std::size_t>(position), values.size() - 2);
  return glm::mix(values[index], values[index + 1], position - static_cast<double>(index));
}

/// Rec.709 colour of a reflectance under daylight, white for 1.
template <typename Reflectance>
glm::dvec3 color_of(const Reflectance& reflectance) {
  const glm::dmat3 to_rec709(3.2404542, -0.9692660, 0.0556434, -1.5371385, 1.8760108, -0.2040259, -0.4985314, 0.0415560,
                             1.0572252);
  glm::dvec3 sum(0), white(0);
  for (double wavelength = 380; wavelength <= 780; wavelength += 2) {
    const glm::dvec3 weight = observer(wavelength) * daylight(wavelength);
    sum += weight * reflectance(wavelength);
    white += weight;
  }
  return (to_rec709 * sum) / (to_rec709 * white);
}

const FilmSensitivity& sensitivity() {
  static const FilmSensitivity table;
  return table;
}

ThinFilm film(float ior, float thickness) { return {&sensitivity(), 1, ior, thickness}; }

// The Gaussians of Belcour and Barla are not the observer's curves: both fits and their lights differ, by up to 0.04 of
// the greatest swing of the colour; what the clamp to [0, 1] cuts off is cut off here too.
TEST(ThinFilm, IsTheSpectralIntegralOfALayer) {
  struct Layer {
    float ior, base;
  };
  for (const Layer layer :
       {Layer{1.3f, 1.5f}, Layer{1.33f, 1.0f}, Layer{1.8f, 1.5f}, Layer{2.4f, 1.5f}, Layer{1.3f, 3}}) {
    const float ior = layer.ior, base = layer.base;
    for (float thickness = 50; thickness <= 1200; thickness *= 1.37f) {
      for (const float cosine : {1.0f, 0.8f, 0.5f, 0.2f}) {
        double least = 1, most = 0;
        const glm::dvec3 expected = color_of([&](double wavelength) {
          double sum = 0;
          for (const bool parallel : {false, true}) {
            sum += 0.5 * layer_reflectance(ior, base, thickness, wavelength, cosine, parallel);
          }
          least = std::min(least, sum), most = std::max(most, sum);
          return sum;
        });
        const Vec3 found = film_reflectance_on_dielectric(film(ior, thickness), Vec3(base), cosine);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(found[c], glm::clamp(expected[c], 0.0, 1.0), 0.12 * (most - least) + 2e-3)
              << "index " << ior << " on " << base << ", " << thickness << " nm, cosine " << cosine << ", channel "
              << c;
        }
      }
    }
  }
}

// Waves that meet in step are one wave: the interface of air and base.
TEST(ThinFilm, WithoutThicknessIsTheBareInterface) {
  for (const float ior : {1.2f, 1.5f, 2.0f}) {
    for (const float base : {1.0f, 1.33f, 1.5f, 2.5f}) {
      for (float cosine = 0.05f; cosine <= 1; cosine += 0.05f) {
        const Vec3 found = film_reflectance_on_dielectric(film(ior, 0.01f), Vec3(base), cosine);
        EXPECT_NEAR(found.y, fresnel_dielectric(cosine, base), 3e-3f) << ior << " on " << base << " at " << cosine;
      }
    }
  }
}

// One of its sides is then no interface.
TEST(ThinFilm, OfTheIndexOfOneSideIsTheOtherSide) {
  for (const float thickness : {120.0f, 400.0f, 5000.0f}) {
    for (const float cosine : {0.1f, 0.4f, 1.0f}) {
      const Vec3 like_base = film_reflectance_on_dielectric(film(1.5f, thickness), Vec3(1.5f), cosine);
      const Vec3 like_air = film_reflectance_on_dielectric(film(1.0f, thickness), Vec3(1.5f), cosine);
      const Vec3 on_metal = film_reflectance_on_metal(film(1.0f, thickness), Vec3(0.9f, 0.6f, 0.3f), cosine);
      const Vec3 metal = fresnel_schlick(Vec3(0.9f, 0.6f, 0.3f), Vec3(1), cosine);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(like_base[c], fresnel_dielectric(cosine, 1.5f), 1e-5f);
        EXPECT_NEAR(like_air[c], fresnel_dielectric(cosine, 1.5f), 1e-5f);
        EXPECT_NEAR(on_metal[c], metal[c], 1e-4f);
      }
    }
  }
}

// Half a wavelength of optical path, with the same change of phase at both sides: what is reflected cancels out. For
// n = sqrt(1.5) the amplitudes are the same. 550 nm / 4 / 1.2247 = 112.3 nm, where green is least.
TEST(ThinFilm, QuarterWaveOfTheRightIndexIsAntireflective) {
  const Vec3 coated = film_reflectance_on_dielectric(film(1.2247f, 112.3f), Vec3(1.5f), 1);
  EXPECT_LT(coated.y, 0.003f);
  EXPECT_GT(coated.x, coated.y);
  EXPECT_GT(coated.z, coated.y);
}

// Interference averages out over the wavelengths of white light: energies add up, not amplitudes.
TEST(ThinFilm, ThickOnesHaveNoColour) {
  const float r12 = 0.04f, r23 = sqr(0.5f / 3.5f);  // air 1.5, 1.5 on 2
  const Vec3 found = film_reflectance_on_dielectric(film(1.5f, 50000), Vec3(2.0f), 1);
  const float expected = r12 + sqr(1 - r12) * r23 / (1 - r12 * r23);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected, 1e-5f);
}

TEST(ThinFilm, StaysWithinEnergy) {
  for (const float ior : {1.0f, 1.3f, 2.5f, 10.0f}) {
    for (const float thickness : {1.0f, 90.0f, 300.0f, 1e6f}) {
      for (const float cosine : {0.0f, 1e-3f, 0.1f, 0.6f, 1.0f}) {
        for (const Vec3 found : {film_reflectance_on_metal(film(ior, thickness), Vec3(1, 0.5f, 0), cosine),
                                 film_reflectance_on_dielectric(film(ior, thickness), Vec3(1, 1.5f, 0.6f), cosine)}) {
          for (int c = 0; c < 3; ++c) {
            EXPECT_GE(found[c], 0);
            EXPECT_LE(found[c], 1);
          }
          if (cosine == 0) {
            EXPECT_GT(found.y, 0.999f);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace candil::test
