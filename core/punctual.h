/// KHR_lights_punctual: lights without a size.
#pragma once

#include <optional>

#include "core/light_sample.h"
#include "core/scene.h"
#include "core/surface.h"

namespace candil {

/// Irradiance, per unit of cosine, that a point or spot light brings to a place `distance` metres away in the direction
/// `-wi` from the light: intensity / distance^2, faded by the spot's cone and by the range (the extension's text:
/// "Inner and Outer Cone Angles", "Range Property").
Vec3 punctual_irradiance(const PunctualLight& light, Vec3 wi, float distance);

/// The light as seen from a surface, with probability 1; nothing if it does not shine there.
std::optional<LightSample> sample_punctual(const PunctualLight& light, const SurfacePoint& from);

/// Luminous power for choosing among lights; a directional light shines on a disc of the scene's radius.
float punctual_power(const PunctualLight& light, float scene_radius);

}  // namespace candil
