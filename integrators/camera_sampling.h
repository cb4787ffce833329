/// Which rays a render shoots from the camera.
#pragma once

#include "core/camera.h"
#include "integrators/integrator.h"

namespace candil {

/// A camera and a pixel filter, bound to the settings of a render.
class CameraSampling {
 public:
  CameraSampling(const Camera& camera, const RenderSettings& settings)
      : rays_(camera, settings.width, settings.height), filter_(settings.filter) {}

  /// The ray of one sample; `pixel` counts from the upper left corner of the image.
  CameraSample sample(Vec2 pixel, const Sampler& sampler) const {
    const Vec2 position = pixel + 0.5f + filter_.sample(sampler.sample_2d(dimension::filter));
    const Vec2 u_lens = rays_.has_lens() ? sampler.sample_2d(dimension::lens) : Vec2(0);
    return {rays_.ray(position, u_lens), sampler};
  }

 private:
  CameraRays rays_;
  PixelFilter filter_;
};

}  // namespace candil
