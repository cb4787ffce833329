/// KHR_lights_punctual: lights without a size.
#pragma once

#include "core/scene.h"

namespace candil {

/// Irradiance, per unit of cosine, that a point or spot light brings to a place `distance` metres away in the direction
/// `-wi` from the light: intensity / distance^2, faded by the spot's cone and by the range (the extension's text:
/// "Inner and Outer Cone Angles", "Range Property").
Vec3 punctual_irradiance(const PunctualLight& light, Vec3 wi, float distance);

/// Luminous power for choosing among lights; a directional light shines on a disc of the scene's radius.
float punctual_power(const PunctualLight& light, float scene_radius);

}  // namespace candil
