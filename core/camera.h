/// Camera rays: perspective or orthographic, pinhole or thin lens.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/ray.h"
#include "core/scene.h"
#include "core/simd.h"

namespace candil {

/// A camera bound to an image size, with everything per-render computed once. The vertical extent is the camera's; the
/// horizontal one follows from the image, except where that would cut what the author framed (image narrower
/// than Camera::aspect): then the horizontal extent is kept.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);
  /// Ray through `pixel` (pixel units, (0, 0) the upper left corner of the image, x to the right, y down). `u_lens` in
  /// [0, 1)^2 picks the point on the lens: a disc, or the regular polygon in it if the camera has blades, uniformly.
  /// Thin lens: Pharr, Jakob and Humphreys 2023, section 5.2.3.
  Ray ray(Vec2 pixel, Vec2 u_lens) const;
  /// Eight rays at once, to the bit, through the pixels (x, y); without a lens.
  std::array<Ray, 8> rays(FloatLanes x, FloatLanes y) const;
  bool has_lens() const { return lens_radius_ > 0; }
  /// Metres from the plane of the camera (and of its lens) to `position`, along the viewing axis.
  float depth(Vec3 position) const { return glm::dot(position - origin_, forward_); }

 private:
  /// Of one ray, or of eight.
  template <typename Number>
  struct Coordinates {
    Number x, y, z;
  };
  /// From the middle of the image plane to a point on it, in world space.
  template <typename Number>
  Coordinates<Number> across(Number x, Number y) const {
    const Number right = (x * pixel_scale_.x - 1.0f) * extent_.x, up = (1.0f - y * pixel_scale_.y) * extent_.y;
    return {right * right_.x + up * up_.x, right * right_.y + up * up_.y, right * right_.z + up * up_.z};
  }
  Vec2 point_on_lens(Vec2 u) const;  // of radius 1

  CameraKind kind_;
  Vec3 origin_, right_, up_, forward_;  // unit axes
  Vec2 extent_;                         // half width and height at unit distance (perspective) or in metres
  Vec2 pixel_scale_;
  float lens_radius_, focus_distance_;
  int lens_blades_;
  Vec2 lens_axis_;  // cosine and sine of the aperture's rotation
};

/// Vertical angle of automatic cameras: that of a portrait lens, radians.
inline constexpr float framing_yfov = 0.6f;

/// A camera that frames the points from `azimuth` (radians about +Y; 0 looks from +Z, positive turns the eye to +X) and
/// `elevation` (radians above the horizon). Without a distance they are centred in the frame of the given aspect ratio
/// and fill it; `distance` is in metres from the centre of their bounding box. No points: as if they were a box around
/// the origin.
Camera frame_points(std::span<const Vec3> points, float azimuth, float elevation, float aspect,
                    std::optional<float> distance = {}, float yfov = framing_yfov);

/// A camera at `from` that looks at `at`, +Y up (or another up when it looks along Y). Focuses at `at`.
Camera look_at(Vec3 from, Vec3 at, float yfov);

}  // namespace candil
