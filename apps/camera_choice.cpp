#include "apps/camera_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "apps/usage_error.h"
#include "core/camera.h"

namespace candil {
namespace {

std::string list_cameras(const Scene& scene) {
  if (scene.cameras.empty()) return "the scene has no cameras";
  std::string list = fmt::format("the scene has {}:", scene.cameras.size());
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    list += fmt::format("{} {} '{}'", i == 0 ? "" : ",", i, scene.cameras[i].name);
  return list;
}

/// A name goes before an index: a camera may be called "2".
std::size_t find_camera(const Scene& scene, const std::string& wanted) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == wanted) return i;
  std::size_t index = 0;
  const char* const end = wanted.data() + wanted.size();
  const auto [last, status] = std::from_chars(wanted.data(), end, index);
  if (status != std::errc() || last != end || index >= scene.cameras.size())
    throw UsageError(fmt::format("--camera: no camera '{}'; {}", wanted, list_cameras(scene)));
  return index;
}

std::optional<std::size_t> camera_in_file(const Scene& scene, const CameraOptions& options) {
  if (options.name) return find_camera(scene, *options.name);
  if (options.orbit || options.look_from || scene.cameras.empty()) return std::nullopt;
  return 0;
}

float framed_aspect(const Camera& camera) {
  return camera.kind == CameraKind::perspective ? camera.aspect : camera.xmag / camera.ymag;
}

ImageSize default_size(float aspect) {
  constexpr int longest = 1024;
  if (!(aspect > 0) || !std::isfinite(aspect)) return {longest, 768};
  const auto shorter = [](float ratio) { return std::max(1, static_cast<int>(std::lround(longest * ratio))); };
  return aspect >= 1 ? ImageSize{longest, shorter(1 / aspect)} : ImageSize{shorter(aspect), longest};
}

/// A glTF camera says nothing about focus: its lens focuses on the middle of the scene, if that is in front of it.
float distance_to_middle(const Scene& scene, const Camera& camera) {
  const Bounds bounds = scene_bounds(scene);
  constexpr float fallback = 1;
  if (bounds.is_empty()) return fallback;
  const Vec3 forward = -glm::normalize(camera.to_world.linear[2]);
  const float distance = glm::dot(bounds.center() - camera.to_world.translation, forward);
  return distance > 0 ? distance : fallback;
}

CameraChoice choose_from_file(const Scene& scene, std::size_t index, std::optional<ImageSize> wanted_size) {
  const Camera& camera = scene.cameras[index];
  CameraChoice choice{camera, wanted_size.value_or(default_size(framed_aspect(camera))),
                      fmt::format("camera {} ({})", index, camera.name)};
  if (!(camera.focus_distance > 0)) choice.camera.focus_distance = distance_to_middle(scene, camera);
  return choice;
}

CameraChoice look_from(const Scene& scene, const CameraOptions& options, ImageSize size,
                       std::span<const Vec3> outline) {
  const Vec3 from = *options.look_from;
  Bounds bounds;
  for (const Vec3 point : outline) bounds.add(point);
  if (outline.empty()) bounds = scene_bounds(scene);
  const Vec3 at = options.look_at.value_or(bounds.is_empty() ? Vec3(0.0f) : bounds.center());
  const float default_yfov = Camera{}.yfov;
  return {look_at(from, at, options.yfov.value_or(default_yfov)), size,
          fmt::format("from {:g},{:g},{:g} at {:g},{:g},{:g}", from.x, from.y, from.z, at.x, at.y, at.z)};
}

CameraChoice frame_scene(const Scene& scene, const CameraOptions& options, ImageSize size,
                         std::span<const Vec3> outline) {
  const std::vector<Vec3> own = outline.empty() ? scene_outline(scene) : std::vector<Vec3>();
  const Orbit orbit = options.orbit.value_or(Orbit{});
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  const Camera camera = frame_points(outline.empty() ? own : outline, orbit.azimuth, orbit.elevation, aspect,
                                     orbit.distance, options.yfov.value_or(framing_yfov));
  return {camera, size, fmt::format("orbit {:g},{:g}", glm::degrees(orbit.azimuth), glm::degrees(orbit.elevation))};
}

}  // namespace

bool is_camera_automatic(const Scene& scene, const CameraOptions& options) {
  return !camera_in_file(scene, options) && !(options.look_from && options.look_at);
}

CameraChoice choose_camera(const Scene& scene, const CameraOptions& options, std::optional<ImageSize> wanted_size,
                           std::span<const Vec3> outline) {
  const std::optional<std::size_t> index = camera_in_file(scene, options);
  const ImageSize size = wanted_size.value_or(default_size(0));
  CameraChoice choice = index               ? choose_from_file(scene, *index, wanted_size)
                        : options.look_from ? look_from(scene, options, size, outline)
                                            : frame_scene(scene, options, size, outline);
  if (options.yfov) choice.camera.yfov = *options.yfov;
  if (options.lens_radius) choice.camera.lens_radius = *options.lens_radius;
  if (options.focus_distance) choice.camera.focus_distance = *options.focus_distance;
  return choice;
}

}  // namespace candil
