/// The environment as a light: radiance by direction, and directions sampled by luminance.
#pragma once

#include "core/distribution.h"
#include "core/scene.h"

namespace candil {

class EnvironmentLight {
 public:
  /// `environment` must outlive the result.
  explicit EnvironmentLight(const Environment& environment);

  struct Sample {
    Vec3 direction, radiance;
    float pdf;  ///< 1/sr.
  };

  bool is_present() const { return environment_.is_present(); }
  /// Radiance, W/(sr m2), arriving from `direction` (unit, away from the scene); bilinear in the image.
  Vec3 radiance(Vec3 direction) const;
  /// A direction with density proportional to the luminance of the image (constant: uniform over the sphere).
  Sample sample(Vec2 u) const;
  /// Density of sample(), 1/sr.
  float pdf(Vec3 direction) const;
  /// Mean radiance over the sphere (luminance), for choosing among lights.
  float mean_luminance() const { return mean_luminance_; }

 private:
  Vec2 to_uv(Vec3 direction) const;
  Vec3 from_uv(Vec2 uv) const;

  const Environment& environment_;
  Distribution2D distribution_;
  float cos_rotation_, sin_rotation_;
  float mean_luminance_ = 0;
};

}  // namespace candil
