// Reflectance of smooth interfaces against textbook values and against complex arithmetic.
#include "materials/fresnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "core/metals.h"

namespace candil::test {
namespace {

/// Fresnel's equations as they are written for amplitudes, with the refracted cosine as a complex number.
double reflectance_by_amplitudes(double cosine, std::complex<double> index) {
  const std::complex<double> refracted = std::sqrt(index * index - (1 - cosine * cosine));  // index x its cosine
  const std::complex<double> perpendicular = (cosine - refracted) / (cosine + refracted);
  const std::complex<double> parallel = (index * index * cosine - refracted) / (index * index * cosine + refracted);
  return 0.5 * (std::norm(perpendicular) + std::norm(parallel));
}

// At normal incidence R = ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
TEST(Fresnel, MetalsAtNormalIncidence) {
  // Gold, 630 nm, 0.188 - 3.403 i: (0.6593 + 11.5804) / (1.4113 + 11.5804) = 0.9421.
  EXPECT_NEAR(fresnel_conductor(1, 0.188f, 3.403f), 0.9421f, 1e-4f);
  // Silver, 532 nm, 0.054 - 3.429 i: (0.8949 + 11.7580) / (1.1109 + 11.7580) = 0.9832.
  EXPECT_NEAR(fresnel_conductor(1, 0.054f, 3.429f), 0.9832f, 1e-4f);
  // Aluminium, 465 nm, 0.686 - 5.635 i: (0.0986 + 31.7532) / (2.8426 + 31.7532) = 0.9207.
  EXPECT_NEAR(fresnel_conductor(1, 0.686f, 5.635f), 0.9207f, 1e-4f);
}

TEST(Fresnel, MetalsAtAllAngles) {
  for (const Metal& metal : metals()) {
    for (int c = 0; c < 3; ++c) {
      const std::complex<double> index(metal.eta[c], -metal.k[c]);
      for (const float cosine : {1.0f, 0.9f, 0.6f, 0.3f, 0.1f, 0.02f, 1e-3f}) {
        EXPECT_NEAR(fresnel_conductor(cosine, metal.eta[c], metal.k[c]), reflectance_by_amplitudes(cosine, index), 2e-6)
            << metal.name << " channel " << c << " cosine " << cosine;
      }
    }
  }
}

TEST(Fresnel, MetalWithoutAbsorptionIsADielectric) {
  for (const float eta : {1.5f, 2.42f, 1 / 1.5f, 0.1f}) {
    for (const float cosine : {1.0f, 0.8f, 0.74f, 0.3f, 0.05f}) {
      EXPECT_NEAR(fresnel_conductor(cosine, eta, 0), fresnel_dielectric(cosine, eta), 3e-6f) << eta << " " << cosine;
    }
  }
}

TEST(Fresnel, ExtremeIndicesStayBetweenNothingAndAll) {
  for (const float eta : {0.0f, 1e-6f, 1.0f, 100.0f}) {
    for (const float k : {0.0f, 1e-6f, 1.0f, 100.0f}) {
      for (const float cosine : {1.0f, 0.5f, 1e-3f}) {
        const float reflectance = fresnel_conductor(cosine, eta, k);
        EXPECT_GE(reflectance, 0) << eta << " " << k << " " << cosine;
        EXPECT_LE(reflectance, 1.000001f) << eta << " " << k << " " << cosine;
      }
    }
  }
  EXPECT_EQ(fresnel_conductor(1, 0, 0), 1);  // (0 - 1)^2 / (0 + 1)^2
}

// The mean over the cosine-weighted hemisphere is the integral of 2 mu R(mu), here by Simpson's rule.
TEST(Fresnel, AverageOfMetals) {
  for (const Metal& metal : metals()) {
    const Vec3 average = fresnel_conductor_average(metal.eta, metal.k);
    for (int c = 0; c < 3; ++c) {
      const std::complex<double> index(metal.eta[c], -metal.k[c]);
      constexpr int intervals = 20000;
      double sum = 0;
      for (int i = 0; i <= intervals; ++i) {
        const double mu = static_cast<double>(i) / intervals;
        const double weight = i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2;
        sum += weight * 2 * mu * reflectance_by_amplitudes(mu, index);
      }
      EXPECT_NEAR(average[c], sum / (3 * intervals), 1e-4) << metal.name << " channel " << c;
    }
  }
}

}  // namespace
}  // namespace candil::test
