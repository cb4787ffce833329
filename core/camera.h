/// Camera rays: perspective or orthographic, pinhole or thin lens.
#pragma once

#include <optional>

#include "core/ray.h"
#include "core/scene.h"

namespace candil {

/// A camera bound to an image size, with everything per-render computed once. The vertical extent is the camera's; the
/// horizontal one follows from the image, except where that would cut what the author framed (image narrower
/// than Camera::aspect): then the horizontal extent is kept.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);
  /// Ray through `pixel` (pixel units, (0, 0) the upper left corner of the image, x to the right, y down). `u_lens` in
  /// [0, 1)^2 picks the point on the lens. Thin lens: Pharr, Jakob and Humphreys 2023, section 5.2.3.
  Ray ray(Vec2 pixel, Vec2 u_lens) const;
  bool has_lens() const { return lens_radius_ > 0; }

 private:
  CameraKind kind_;
  Vec3 origin_, right_, up_, forward_;  // unit axes
  Vec2 extent_;                         // half width and height at unit distance (perspective) or in metres
  Vec2 pixel_scale_;
  float lens_radius_, focus_distance_;
};

/// A camera that frames the box from `azimuth` (radians about +Y; 0 looks from +Z, positive turns the eye to +X) and
/// `elevation` (radians above the horizon). Without a distance the box fills the frame of the given aspect ratio.
/// `distance` is in metres from the box's centre.
Camera frame_bounds(const Bounds& bounds, float azimuth, float elevation, float aspect,
                    std::optional<float> distance = {}, float yfov = 0.6f);

/// A camera at `from` that looks at `at`, +Y up (or another up when it looks along Y). Focuses at `at`.
Camera look_at(Vec3 from, Vec3 at, float yfov);

}  // namespace candil
