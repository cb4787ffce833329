#include "tests/integrators/mean_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/camera.h"

namespace candil::test {
namespace {

/// Mean over the image and its standard error, from the variances that the film kept.
Estimate image_mean(const Film& film) {
  const Image mean = film.mean(), variance = film.variance();
  const std::size_t pixels = mean.pixels.size() / 4;
  Estimate estimate;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (int c = 0; c < 3; ++c) {
      estimate.mean[c] += mean.pixels[4 * i + c] / static_cast<float>(pixels);
      estimate.standard_error[c] += variance.pixels[3 * i + c];
    }
  }
  estimate.standard_error = glm::sqrt(estimate.standard_error) / static_cast<float>(pixels);
  return estimate;
}

}  // namespace

void expect_same_mean(const Stage& stage, IntegratorKind first, IntegratorKind second, float largest_error) {
  const Camera camera = look_at(Vec3(0.4f, 0.6f, 2.9f), Vec3(0, -0.1f, 0), 1.1f);
  RenderSettings settings;
  settings.width = settings.height = 32;
  settings.samples_per_pixel = 1024;
  settings.filter = FilterKind::box;
  settings.max_bounces = 200;
  settings.integrator = first;
  const RenderResult a_result = render(stage.context(), camera, settings);
  settings.integrator = second;
  settings.seed = 1;  // independent of the other
  const RenderResult b_result = render(stage.context(), camera, settings);
  EXPECT_EQ(a_result.non_finite_samples + b_result.non_finite_samples, 0u);
  const Estimate a = image_mean(a_result.film), b = image_mean(b_result.film);
  for (int c = 0; c < 3; ++c) {
    const float error = std::hypot(a.standard_error[c], b.standard_error[c]);
    EXPECT_LT(error, largest_error * b.mean[c]) << "too noisy to tell";
    EXPECT_NEAR(a.mean[c], b.mean[c], 5.5f * error) << "channel " << c << ", ratio " << a.mean[c] / b.mean[c];
  }
}

}  // namespace candil::test
