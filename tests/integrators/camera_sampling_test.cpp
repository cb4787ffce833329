/// Camera rays are made eight at a time: each has to be what it would be alone.
#include "integrators/camera_sampling.h"

#include <gtest/gtest.h>

namespace candil {
namespace {

Camera make_camera(CameraKind kind, float lens_radius) {
  Camera camera = look_at({1, 2, 3}, {0.1f, 0.2f, 0.3f}, 0.7f);
  camera.kind = kind;
  camera.xmag = camera.ymag = 1.5f;
  camera.lens_radius = lens_radius;
  return camera;
}

struct Setting {
  const char* name;
  CameraKind kind;
  float lens_radius;
  FilterKind filter;
};

void PrintTo(const Setting& setting, std::ostream* stream) { *stream << setting.name; }

class EveryCamera : public testing::TestWithParam<Setting> {};

TEST_P(EveryCamera, MakesTheSameRaysAloneAndTogether) {
  const Setting& setting = GetParam();
  const Camera camera = make_camera(setting.kind, setting.lens_radius);
  RenderSettings settings;
  settings.width = 37, settings.height = 23, settings.seed = 7, settings.filter = setting.filter;
  const CameraSampling sampling(camera, settings);
  const CameraRays rays(camera, settings.width, settings.height);
  const PixelFilter filter(setting.filter);
  std::vector<CameraSample> samples;
  // Numbers of samples that fill groups of eight exactly, that do not, and less than one group.
  for (const std::uint32_t count : {1u, 3u, 8u, 16u}) {
    const PixelRow row{5, 16, 20};
    sampling.sample(row, 2, count, samples);
    ASSERT_EQ(samples.size(), 11 * count);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto x = static_cast<std::uint32_t>(5 + i / count), sample = static_cast<std::uint32_t>(2 + i % count);
      const Sampler sampler({x, 20}, sample, settings.seed);
      const Vec2 position = Vec2(x, 20) + 0.5f + filter.sample(sampler.sample_2d(dimension::filter));
      const Ray expected = rays.ray(position, sampler.sample_2d(dimension::lens));
      ASSERT_EQ(samples[i].ray.origin, expected.origin) << i;
      ASSERT_EQ(samples[i].ray.direction, expected.direction) << i;
      ASSERT_EQ(samples[i].sampler.sample_2d(9), sampler.sample_2d(9)) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, EveryCamera,
    testing::Values(Setting{"perspective", CameraKind::perspective, 0, FilterKind::blackman_harris},
                    Setting{"lens", CameraKind::perspective, 0.1f, FilterKind::gaussian},
                    Setting{"orthographic", CameraKind::orthographic, 0, FilterKind::box},
                    Setting{"orthographic_lens", CameraKind::orthographic, 0.1f, FilterKind::blackman_harris}),
    [](const auto& camera) { return camera.param.name; });

}  // namespace
}  // namespace candil
