/// Which rays a render shoots from the camera.
#pragma once

#include <vector>

#include "core/camera.h"
#include "core/pixel_filter.h"
#include "integrators/integrator.h"

namespace candil {

/// Pixels [left, right) of row y, which counts from the top.
struct PixelRow {
  int left, right, y;
};

/// A camera and a pixel filter, bound to the settings of a render.
class CameraSampling {
 public:
  CameraSampling(const Camera& camera, const RenderSettings& settings);

  /// Replaces what is in `samples` by samples [first_sample, first_sample + count) of every pixel, pixel by pixel.
  void sample(const PixelRow& row, std::uint32_t first_sample, std::uint32_t count,
              std::vector<CameraSample>& samples) const;

 private:
  CameraRays rays_;
  PixelFilter filter_;
  std::uint64_t seed_;
};

}  // namespace candil
