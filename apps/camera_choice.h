/// Which camera looks at the scene, and how large the picture is.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "apps/option_values.h"
#include "core/scene.h"

namespace candil {

/// Where an automatic camera stands; angles in radians as for frame_points().
struct Orbit {
  float azimuth = 0.6108652f;          ///< 35 degrees.
  float elevation = 0.3490659f;        ///< 20 degrees.
  std::optional<float> distance = {};  ///< Metres from the centre of the scene; none: the scene fills the frame.
};

/// At most one of `name`, `orbit` and `look_from` is set.
struct CameraOptions {
  std::optional<std::string> name;  ///< Index or name of a camera in the file.
  std::optional<Orbit> orbit;
  std::optional<Vec3> look_from, look_at;
  std::optional<float> yfov;            ///< Full vertical angle, radians.
  std::optional<float> lens_radius;     ///< Metres.
  std::optional<float> focus_distance;  ///< Metres.
};

struct CameraChoice {
  Camera camera;
  ImageSize size;
  std::string description;  ///< For file headers: "camera 0 (Main)", "orbit 35,20".
};

/// The camera that was asked for, else the first one in the file, else one that frames the scene. Without a
/// wanted size: 1024 pixels on the longer side in the proportions that the camera was made for, or 1024x768. Throws
/// UsageError when the file has no such camera.
/// `outline` (empty: that of the scene) is what an automatic camera frames and looks at.
CameraChoice choose_camera(const Scene& scene, const CameraOptions& options, std::optional<ImageSize> wanted_size,
                           std::span<const Vec3> outline = {});

/// Whether choose_camera() would frame or look at the middle of the scene.
bool is_camera_automatic(const Scene& scene, const CameraOptions& options);

}  // namespace candil
