/// What shines from beyond the scene.
#pragma once

#include <optional>
#include <string>

#include "core/scene.h"

namespace candil {

struct EnvironmentOptions {
  std::string image;          ///< File; empty: none was asked for.
  std::optional<Vec3> color;  ///< Radiance, W/(sr m2); black: no environment.
  float rotation = 0;         ///< Radians about +Y, counter-clockwise seen from above.
  float strength = 1;         ///< Factor of the radiance.
};

/// The environment to render with: the image or the colour that was asked for, else the scene's own, else, for a
/// scene that says nothing of light (`is_lit`) and has none of its own (has_light()), the built-in studio. Throws
/// InputError when the image cannot be used.
Environment choose_environment(const Scene& scene, const EnvironmentOptions& options, bool is_lit);

}  // namespace candil
