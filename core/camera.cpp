#include "core/camera.h"

#include <cmath>

#include "core/warp.h"

namespace candil {

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : kind_(camera.kind),
      origin_(camera.to_world.translation),
      forward_(-glm::normalize(camera.to_world.linear[2])),
      lens_radius_(camera.lens_radius),
      focus_distance_(camera.focus_distance) {
  // Rebuilt from the viewing direction and the up axis: a scaled or mirrored node still gives a rigid camera.
  right_ = glm::normalize(glm::cross(forward_, camera.to_world.linear[1]));
  up_ = glm::cross(right_, forward_);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const bool is_perspective = kind_ == CameraKind::perspective;
  const float half_height = is_perspective ? std::tan(0.5f * camera.yfov) : camera.ymag;
  const float framed_aspect = is_perspective ? camera.aspect : camera.xmag / camera.ymag;
  extent_ = aspect < framed_aspect ? half_height * framed_aspect * Vec2(1, 1 / aspect) : half_height * Vec2(aspect, 1);
  pixel_scale_ = 2.0f / Vec2(width, height);
}

Ray CameraRays::ray(Vec2 pixel, Vec2 u_lens) const {
  const Vec2 plane = (pixel * pixel_scale_ - 1.0f) * Vec2(1, -1) * extent_;
  const Vec3 across = plane.x * right_ + plane.y * up_;
  const bool is_perspective = kind_ == CameraKind::perspective;
  const Vec3 origin = is_perspective ? origin_ : origin_ + across;
  const Vec3 direction = is_perspective ? forward_ + across : forward_;
  if (!has_lens()) return {origin, glm::normalize(direction)};
  const Vec2 lens = lens_radius_ * sample_disc(u_lens);
  const Vec3 shift = lens.x * right_ + lens.y * up_;
  return {origin + shift, glm::normalize(focus_distance_ * direction - shift)};
}

Camera look_at(Vec3 from, Vec3 at, float yfov) {
  Camera camera;
  const Vec3 offset = from - at;
  const float distance = glm::length(offset);
  const Vec3 back = distance > 0 ? offset / distance : Vec3(0, 0, 1);
  const Vec3 up = std::abs(back.y) < 0.9999f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
  const Vec3 right = glm::normalize(glm::cross(up, back));
  camera.to_world = {Mat3(right, glm::cross(back, right), back), from};
  camera.yfov = yfov;
  if (distance > 0) camera.focus_distance = distance;
  return camera;
}

Camera frame_bounds(const Bounds& bounds, float azimuth, float elevation, float aspect, std::optional<float> distance,
                    float yfov) {
  constexpr float margin = 1.06f;
  const Bounds box = bounds.is_empty() ? Bounds{Vec3(-1), Vec3(1)} : bounds;
  const Vec3 back(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  std::cos(elevation) * std::cos(azimuth));
  Camera camera = look_at(box.center() + back, box.center(), yfov);
  const Vec3 right = camera.to_world.linear[0], up = camera.to_world.linear[1];
  const float tan_y = std::tan(0.5f * yfov), tan_x = tan_y * aspect;
  float fitting = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = Vec3(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                        corner & 4 ? box.high.z : box.low.z) -
                   box.center();
    const float across = glm::max(std::abs(glm::dot(p, right)) / tan_x, std::abs(glm::dot(p, up)) / tan_y);
    fitting = glm::max(fitting, glm::dot(p, back) + margin * across);
  }
  if (!(fitting > 0)) fitting = 1;  // a single point
  camera.focus_distance = distance.value_or(fitting);
  camera.to_world.translation = box.center() + camera.focus_distance * back;
  return camera;
}

}  // namespace candil
