#include "core/camera.h"

#include <cmath>

#include "core/warp.h"

namespace candil {

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : kind_(camera.kind),
      origin_(camera.to_world.translation),
      forward_(-glm::normalize(camera.to_world.linear[2])),
      lens_radius_(camera.lens_radius),
      focus_distance_(camera.focus_distance),
      lens_blades_(camera.lens_blades),
      lens_axis_(std::cos(camera.lens_rotation), std::sin(camera.lens_rotation)) {
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
  const auto [x, y, z] = across(pixel.x, pixel.y);
  const bool is_perspective = kind_ == CameraKind::perspective;
  const Vec3 origin = is_perspective ? origin_ : origin_ + Vec3(x, y, z);
  const Vec3 direction = is_perspective ? forward_ + Vec3(x, y, z) : forward_;
  if (!has_lens()) return {origin, glm::normalize(direction)};
  const Vec2 lens = lens_radius_ * point_on_lens(u_lens);
  const Vec3 shift = lens.x * right_ + lens.y * up_;
  return {origin + shift, glm::normalize(focus_distance_ * direction - shift)};
}

std::array<Ray, 8> CameraRays::rays(FloatLanes px, FloatLanes py) const {
  const auto [x, y, z] = across(px, py);
  std::array<Ray, 8> rays;
  if (kind_ == CameraKind::orthographic) {
    const Vec3 direction = glm::normalize(forward_);
    for (int i = 0; i < 8; ++i) rays[i] = {origin_ + Vec3(x[i], y[i], z[i]), direction};
    return rays;
  }
  const FloatLanes dx = forward_.x + x, dy = forward_.y + y, dz = forward_.z + z;
  const FloatLanes squared = dx * dx + dy * dy + dz * dz;
  FloatLanes inverse;
  for (int i = 0; i < 8; ++i) inverse[i] = 1 / std::sqrt(squared[i]);
  for (int i = 0; i < 8; ++i) rays[i] = {origin_, Vec3(dx[i], dy[i], dz[i]) * inverse[i]};
  return rays;
}

Vec2 CameraRays::point_on_lens(Vec2 u) const {
  if (lens_blades_ < 3) return sample_disc(u);
  const Vec2 p = sample_regular_polygon(u, lens_blades_);
  return {p.x * lens_axis_.x - p.y * lens_axis_.y, p.x * lens_axis_.y + p.y * lens_axis_.x};
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

Camera frame_points(std::span<const Vec3> points, float azimuth, float elevation, float aspect,
                    std::optional<float> distance, float yfov) {
  constexpr float margin = 1.06f;
  static constexpr Vec3 around_origin[] = {Vec3(-1), Vec3(1)};
  if (points.empty()) points = around_origin;
  Bounds box;
  for (const Vec3 p : points) box.add(p);
  const Vec3 back(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  std::cos(elevation) * std::cos(azimuth));
  Camera camera = look_at(box.center() + back, box.center(), yfov);
  const Mat3& axes = camera.to_world.linear;
  Vec3 eye(0, 0, distance.value_or(0));  // from the centre along the camera's axes
  if (!distance) {
    // An eye at (x, y, d) sees a point p if |p.x - x| <= t (d - p.z), t the tangent of the half angle, and the same for
    // y. The nearest such eye has high - low = 2 t d for the larger of the two axes, and sits midway on both.
    const float tan_y = std::tan(0.5f * yfov) / margin;
    const Vec2 tangent(tan_y * aspect, tan_y);
    Vec2 high(-infinity), low(infinity);
    for (const Vec3 p : points) {
      const Vec3 local = (p - box.center()) * axes;  // dot products with the axes
      high = glm::max(high, Vec2(local) + tangent * local.z);
      low = glm::min(low, Vec2(local) - tangent * local.z);
    }
    const Vec2 distances = 0.5f * (high - low) / tangent;
    eye = Vec3(0.5f * (high + low), glm::max(distances.x, distances.y));
    if (!(eye.z > 0)) eye.z = 1;  // a single point
  }
  camera.focus_distance = eye.z;
  camera.to_world.translation = box.center() + axes * eye;
  return camera;
}

}  // namespace candil
